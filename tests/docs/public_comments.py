"""Every public type and function of include/navjit has a comment: public_comments.py CLANG ROOT BUILD.

Reads the declarations from Clang's syntax tree. A comment counts for the declarations that follow it
without an empty line. Not asked for: what is private, deleted, defaulted or an operator, destructors,
and forward declarations.
"""
import json
import pathlib
import re
import subprocess
import sys

FUNCTIONS = {"FunctionDecl", "CXXMethodDecl", "CXXConstructorDecl"}
TYPES = {"CXXRecordDecl", "EnumDecl", "TypeAliasDecl"}


def documents(text):
    decoder, at = json.JSONDecoder(), 0
    while True:
        while at < len(text) and text[at] != "{":
            at += 1
        if at >= len(text):
            return
        node, at = decoder.raw_decode(text, at)
        yield node


class Reader:
    """Walks declarations; Clang leaves out file and line where they are as before."""

    def __init__(self, folder):
        self.folder, self.file, self.line, self.found = folder, "", 0, {}

    def place(self, node):
        if isinstance(node, dict):
            for key in ("spellingLoc", "expansionLoc"):
                if key in node:
                    self.place(node[key])
            self.file = node.get("file", self.file)
            self.line = node.get("line", self.line)

    def walk(self, node, public):
        self.place(node.get("loc"))
        file, line = self.file, self.line
        for end in ("begin", "end"):
            self.place(node.get("range", {}).get(end))
        kind = node.get("kind")
        if public and kind in FUNCTIONS | TYPES and not node.get("isImplicit") and node.get("name"):
            self.note(node, kind, file, line)
        if kind in ("AccessSpecDecl",) or kind in FUNCTIONS:
            public_inside = False
        else:
            public_inside = public
        default = node.get("tagUsed") != "class"
        access = default
        for inner in node.get("inner", []):
            if kind == "CXXRecordDecl":
                if inner.get("kind") == "AccessSpecDecl":
                    access = inner.get("access") == "public"
                self.walk(inner, public_inside and access)
            else:
                self.walk(inner, public_inside)

    def note(self, node, kind, file, line):
        path = pathlib.Path(file)
        if path.parent != self.folder:
            return
        if kind in FUNCTIONS and (node.get("explicitlyDeleted") or node.get("explicitlyDefaulted")
                                  or node["name"].startswith("operator")):
            return
        if kind == "CXXRecordDecl" and not node.get("completeDefinition"):
            return
        if "previousDecl" in node:
            return
        self.found[(path, line, node["name"])] = node


def has_comment(lines, line):
    """`line` counts from 1. A comment above, or at the end of the line."""
    if "///" in lines[line - 1]:
        return True
    for text in reversed(lines[: line - 1]):
        if text.strip().startswith("///"):
            return True
        if text.strip() == "" or re.search(r"[{}]\s*$|:\s*$", text):
            return False
    return False


def main():
    clang, root, build = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
    folder = root / "include" / "navjit"
    result = subprocess.run(
        [clang, "-std=c++20", "-fsyntax-only", "-fparse-all-comments", "-Xclang", "-ast-dump=json",
         "-Xclang", "-ast-dump-filter=navjit::", f"-I{root}/include", f"-I{build}/include", "-x", "c++",
         str(folder / "navjit.hpp")], capture_output=True, text=True, check=True)
    reader = Reader(folder)
    for node in documents(result.stdout):
        reader.walk(node, True)
    missing = []
    for (path, line, name) in sorted(reader.found):
        lines = path.read_text().splitlines()
        if not has_comment(lines, line):
            missing.append(f"{path.relative_to(root)}:{line}: {name} has no comment")
    print("\n".join(missing))
    if len(reader.found) < 100:
        print(f"only {len(reader.found)} declarations were found")
        return 1
    print(f"{len(reader.found)} declarations, {len(missing)} without a comment")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
