"""What the documents and docstrings say is what the package does."""

import ast
import doctest
import inspect
import pathlib
import re
import subprocess
import sys

import pytest

import navjit
from navjit import _core

FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def run(text, name, names):
    test = doctest.DocTestParser().get_doctest(text, names, name, name, 0)
    runner = doctest.DocTestRunner(optionflags=FLAGS)
    report = []
    runner.run(test, out=report.append, clear_globs=False)
    names.update(test.globs)
    assert runner.failures == 0, "".join(report)
    return runner.tries


def test_the_guide():
    names, tries = {}, 0
    text = pathlib.Path("docs/python.md").read_text()
    for block in re.findall(r"^```python\n(.*?)^```", text, re.S | re.M):
        tries += run(block, "docs/python.md", names)
    assert tries > 20


def public_members():
    for name in navjit.__all__:
        yield name, getattr(navjit, name)
        if inspect.isclass(getattr(navjit, name)):
            for member, value in vars(getattr(navjit, name)).items():
                if not member.startswith("_"):
                    yield f"{name}.{member}", value


def test_docstrings():
    assert run(navjit.__doc__, "navjit", {}) > 3
    for name, value in public_members():
        doc = getattr(value, "__doc__", None)
        assert doc or name in ("__version__", "state_dtype"), name
        if doc and ">>>" in doc:
            run(doc, name, {})


def test_stubs_have_what_there_is():
    tree = ast.parse((pathlib.Path(navjit.__file__).parent / "_core.pyi").read_text())
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    others = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)} | {
        node.target.id for node in tree.body if isinstance(node, ast.AnnAssign)
    }
    there = {name for name in vars(_core) if not name.startswith("_")} | {"__version__"}
    assert there == set(classes) | others
    for name, node in classes.items():
        kind = getattr(_core, name)
        members = {n.name for n in node.body if isinstance(n, ast.FunctionDef)}
        public = {m for m in vars(kind) if not m.startswith("_")}
        assert {m for m in members if not m.startswith("_")} == public, name


def test_types_are_right():
    pytest.importorskip("mypy")
    made = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir=/dev/null", "-p", "navjit"],
        capture_output=True,
        text=True,
    )
    assert made.returncode == 0, made.stdout + made.stderr
    made = subprocess.run(
        [sys.executable, "-m", "mypy", "--cache-dir=/dev/null"]
        + [str(p) for p in pathlib.Path("examples/python").glob("*.py")],
        capture_output=True,
        text=True,
    )
    assert made.returncode == 0, made.stdout + made.stderr
