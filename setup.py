"""`pip install .`: CMake builds the Python package, setuptools makes a wheel of it; docs/install.md.

NAVJIT_BUILD: a folder where navjit is already built with CMake, to take it from there."""

import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

root = Path(__file__).resolve().parent


def version():
    return re.search(r"project\(navjit VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text())[1]


class BuildByCMake(build_ext):
    def run(self):
        build = os.environ.get("NAVJIT_BUILD") or self.configured()
        subprocess.run(["cmake", "--install", build, "--component", "wheel", "--prefix",
                        Path(self.build_lib).resolve()], check=True)

    def configured(self):
        build = Path(self.build_temp).resolve()
        options = {"CMAKE_BUILD_TYPE": "Release", "Python_EXECUTABLE": sys.executable}
        # What other machines may get, and no more than Python needs.
        for name in ("NATIVE", "COMMAND", "TESTS", "BENCH"):
            options[f"NAVJIT_{name}"] = "OFF"
        try:
            import pybind11
            options["pybind11_DIR"] = pybind11.get_cmake_dir()
        except ImportError:
            pass  # CMake looks for it among the system's packages
        subprocess.run(["cmake", "-S", root, "-B", build, *(f"-D{k}={v}" for k, v in options.items())],
                       check=True)
        subprocess.run(["cmake", "--build", build, "--parallel", str(len(os.sched_getaffinity(0))),
                        "--target", "navjit_python", "navjit_python_files"], check=True)
        return build


setup(version=version(), packages=[], ext_modules=[Extension("navjit._core", [])],
      cmdclass={"build_ext": BuildByCMake})
