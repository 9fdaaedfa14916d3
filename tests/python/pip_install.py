"""`pip install .` of the build in BUILD, without a network, into FOLDER; imports it from there.

Usage: pip_install.py SOURCE BUILD FOLDER"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

source, build, folder = (Path(a).resolve() for a in sys.argv[1:4])
shutil.rmtree(folder, ignore_errors=True)
# A copy, since setuptools leaves its own folders beside what it builds.
copy = folder / "source"
copy.mkdir(parents=True)
for name in ("pyproject.toml", "setup.py", "README.md", "CMakeLists.txt"):
    shutil.copy(source / name, copy)
clean = {k: v for k, v in os.environ.items() if not k.startswith(("PIP_", "PYTHON"))}
subprocess.run([sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-deps", "--no-index",
                "--disable-pip-version-check", "--target", folder / "site", copy],
               check=True, env=dict(clean, NAVJIT_BUILD=str(build)))

package = folder / "site" / "navjit"
for name in ("__init__.py", "results.py", "_core.pyi", "py.typed"):
    assert (package / name).is_file(), f"{name} was not installed"
subprocess.run([sys.executable, "-c", f"""
import importlib.metadata
import navjit
assert navjit.__file__.startswith({str(package)!r}), navjit.__file__
assert importlib.metadata.version("navjit") == navjit.__version__
with open("/proc/self/maps") as maps:
    libraries = {{line.split()[-1] for line in maps if "libnavjit" in line}}
assert libraries and all(l.startswith({str(package)!r}) for l in libraries), libraries
runtime = navjit.Runtime(navjit.read_gdml({str(source / "detectors" / "absorber.gdml")!r}))
assert runtime.scan([0, 0, 0], [0, 0, 1]).steps[0] > 0
"""], check=True, cwd=folder, env=dict(clean, PYTHONPATH=str(folder / "site")))
# The wheel is for this interpreter and this machine only.
wheels = list((folder / "site").glob("navjit-*.dist-info"))
assert len(wheels) == 1, wheels
tag = f"cp{sys.version_info.major}{sys.version_info.minor}-cp"
text = (wheels[0] / "WHEEL").read_text()
assert tag in text and "Root-Is-Purelib: false" in text, text
