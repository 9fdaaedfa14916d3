"""Reads Spack's recipe without Spack: what it says has to agree with the build's own files.

Usage: spack_recipe.py SOURCE"""

import re
import sys
import types
from pathlib import Path

source = Path(sys.argv[1])
recipe = source / "packaging/spack/spack_repo/navjit/packages/navjit/package.py"
said = {"version": [], "variant": [], "depends_on": [], "define": [], "define_from_variant": []}


class Ignored:
    """Takes what it is given, and serves for `with`."""

    def __call__(self, *arguments, **options):
        return self

    def __enter__(self):
        return self

    def __exit__(self, *what):
        return False


def noted(directive):
    return lambda *arguments, **options: said[directive].append((arguments, options))


class Package:
    """What a recipe inherits, as far as this one uses it."""

    spec = types.SimpleNamespace(satisfies=lambda what: True)

    def define(self, name, value):
        said["define"].append(name)

    def define_from_variant(self, name, variant):
        said["define_from_variant"].append((name, variant))


spack = types.ModuleType("spack.package")
for name in ("license", "extends", "requires", "when", "conflicts"):
    setattr(spack, name, Ignored())
for name in ("version", "variant", "depends_on"):
    setattr(spack, name, noted(name))
spack.python = types.SimpleNamespace(path="python3")
cmake = types.ModuleType("spack_repo.builtin.build_systems.cmake")
cmake.CMakePackage = Package
# In Spack 1, what belongs to one build system is in a module beside the general one.
cmake.generator = Ignored()
for name in ("spack", "spack_repo", "spack_repo.builtin", "spack_repo.builtin.build_systems"):
    sys.modules[name] = types.ModuleType(name)
sys.modules["spack.package"], sys.modules[cmake.__name__] = spack, cmake

names = {}
exec(compile(recipe.read_text(), recipe, "exec"), names)
names["Navjit"]().cmake_args()

lists = (source / "CMakeLists.txt").read_text()
version = re.search(r"project\(navjit VERSION ([0-9.]+)", lists)[1]
assert [a[0] for a, _ in said["version"]] == [version], f"the recipe is not of version {version}"
options = set(re.findall(r"^option\((NAVJIT_\w+)", lists, re.M))
variants = {a[0] for a, _ in said["variant"]}
for name, variant in said["define_from_variant"]:
    assert name in options, f"there is no option {name}"
    assert variant in variants, f"there is no variant {variant}"
for name in said["define"]:
    assert not name.startswith("NAVJIT_") or name in options, name
for _, condition in said["depends_on"]:
    for name in re.findall(r"[+~](\w+)", condition.get("when", "")):
        assert name in variants, f"there is no variant {name}"

# Every package that CMake has to find must be among the dependencies.
depends = {re.split(r"[@ +]", a[0])[0] for a, _ in said["depends_on"]}
wanted = {"EXPAT": "expat", "ZLIB": "zlib-api", "LibLZMA": "xz", "spdlog": "spdlog", "nlohmann_json": "nlohmann-json",
          "CLI11": "cli11", "PNG": "libpng", "LLVM": "llvm", "OpenSSL": "openssl", "MPI": "mpi",
          "VecGeom": None, "Python": None, "pybind11": "py-pybind11", "Threads": None, "Geant4": None}
# These are found by a library or a header; LLVM's are in its package.
libraries = {"LZ4": "lz4", "ZSTD": "zstd", "MUPARSER": "muparser", "VC": "vc", "LLVM": "llvm", "CLANG": "llvm"}
rooms = [path for path in source.glob("*/CMakeLists.txt")
         if path.parent.name not in ("bench", "build", "examples", "tests")]
texts = [lists] + [path.read_text() for path in [*rooms, *source.glob("adapters/*/CMakeLists.txt")]]
for found in re.findall(r"find_package\((\w+)", "\n".join(texts)):
    assert found in wanted, f"the recipe knows no {found}"
    assert wanted[found] is None or wanted[found] in depends, f"{wanted[found]} is no dependency"
for found in re.findall(r"find_(?:library|path)\(NAVJIT_([A-Z0-9]+)_", "\n".join(texts)):
    assert found in libraries, f"the recipe knows no {found}"
    assert libraries[found] in depends, f"{libraries[found]} is no dependency"
