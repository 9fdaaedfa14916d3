"""Runs docs/tutorial.md: installs the build, writes the page's files, and runs its commands in order.

Usage: tutorial.py BUILD PAGE FOLDER PYTHON"""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

build, page, folder, python = (Path(a).absolute() for a in sys.argv[1:5])
prefix, work = folder / "prefix", folder / "work"
shutil.rmtree(folder, ignore_errors=True)
work.mkdir(parents=True)
for component in ("runtime", "development", "python"):
    subprocess.run(["cmake", "--install", build, "--prefix", prefix, "--component", component],
                   check=True, stdout=subprocess.DEVNULL)

# The Python that the package was built for comes first.
(folder / "bin").mkdir()
(folder / "bin" / "python3").symlink_to(python)
environment = dict(os.environ, HOME=str(folder), XDG_CACHE_HOME=str(folder / "cache"),
                   PATH=f"{folder / 'bin'}:{os.environ['PATH']}",
                   # mpirun as root, on fewer processors than processes, with no way to other machines.
                   OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_plm_rsh_agent="")

# A file's name in backquotes with a colon stands above the contents of that file.
blocks = re.findall(r"(?:^`([\w.]+)`:\n\n)?^```(\w+)\n(.*?)^```$", page.read_text(), re.M | re.S)
commands, written = [], 0
for name, language, text in blocks:
    if name:
        (work / name).write_text(text)
        written += 1
    elif text.startswith("mpirun ") and shutil.which("mpirun") is None:
        print(f"left out, for there is no mpirun: {text}")
    elif language == "sh":
        commands.append(text)
script = "\n".join(commands).replace("/opt/navjit", str(prefix))
print(script, flush=True)
# From a file: mpirun would read the rest of a script that comes through standard input.
(folder / "script").write_text(script)
result = subprocess.run(["bash", "-eux", folder / "script"], text=True, cwd=work, env=environment,
                        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
print(result.stdout)
if result.returncode != 0:
    sys.exit(f"tutorial.py: the commands of {page} ended with {result.returncode}")
if len(commands) < 8 or written < 3:
    sys.exit(f"tutorial.py: {page} has {len(commands)} blocks of commands and {written} files: too few")

made = re.findall(r"(?:-o|--out|--report|--html) ([\w.]+)(?=\s)", script + "\n")
for name in made:
    if not (work / name).is_file() or (work / name).stat().st_size == 0:
        sys.exit(f"tutorial.py: {name} was not written")
if (work / "together.json").is_file():
    together, parts = (json.loads((work / name).read_text()) for name in ("together.json", "all.json"))
    if together["steps"] != parts["steps"] or together["processes"] != 4:
        sys.exit(f"tutorial.py: {together['steps']} steps by MPI, and {parts['steps']} in parts")
for said in ("mm of crystals for each ray", "eta +0.0: "):
    if said not in result.stdout:
        sys.exit(f"tutorial.py: nothing was said of '{said}'")
