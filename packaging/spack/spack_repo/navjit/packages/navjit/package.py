"""Spack's recipe of navjit; docs/install.md says how it is used."""

from spack_repo.builtin.build_systems.cmake import CMakePackage, generator

from spack.package import *


class Navjit(CMakePackage):
    """Particle transport through detector geometries, with navigators that are compiled for the
    detector while the simulation runs. Library, command and Python package."""

    license("Apache-2.0")

    # There is no address to fetch it from: `spack develop` or `spack dev-build` in a copy of it.
    version("0.1.0")

    variant("jit", default=True, description="Compile at run time, with Clang and LLVM")
    variant("native", default=False, description="Compile for the processor of this machine alone")
    variant("mpi", default=False, description="Let the command run one run in many processes")
    variant("python", default=False, description="Build the Python package")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("help2man", type="build")

    depends_on("expat")
    depends_on("zlib-api")
    depends_on("xz")
    depends_on("lz4")
    depends_on("zstd")
    depends_on("muparser")
    depends_on("vc@1.4:")
    depends_on("spdlog")
    depends_on("nlohmann-json")
    depends_on("openssl")
    depends_on("cli11@2.1:")
    depends_on("libpng@1.6.22:")
    # Clang's and LLVM's shared libraries, the one linked with the other.
    depends_on("llvm@19.1 +clang +llvm_dylib +link_llvm_dylib", when="+jit")
    depends_on("mpi", when="+mpi")

    with when("+python"):
        extends("python@3.9:")
        depends_on("py-pybind11@2.10:", type="build")
        depends_on("py-numpy", type=("build", "run"))

    # Modules of compiled code are for x86-64.
    requires("target=x86_64:")

    generator("ninja")

    def cmake_args(self):
        args = [
            self.define("NAVJIT_TESTS", False),
            self.define("NAVJIT_BENCH", False),
            self.define_from_variant("NAVJIT_JIT", "jit"),
            self.define_from_variant("NAVJIT_NATIVE", "native"),
            self.define_from_variant("NAVJIT_MPI", "mpi"),
            self.define_from_variant("NAVJIT_PYTHON", "python"),
            self.define("CMAKE_DISABLE_FIND_PACKAGE_VecGeom", True),
            self.define("CMAKE_DISABLE_FIND_PACKAGE_Geant4", True),
        ]
        if self.spec.satisfies("+python"):
            args.append(self.define("Python_EXECUTABLE", python.path))
        return args
