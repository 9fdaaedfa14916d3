"""A page of Markdown, or a header, as Doxygen wants it: page.py FILE, to the standard output.

A page's name is that of its file. Links between pages go by these names, and what is no page
of the site (examples, licence) is named and not linked. Specialisations of std's templates have
no page."""

import re
import sys
from pathlib import Path


def name_of(path):
    """Of a page, by its path in the project."""
    path = Path(path)
    if path.name == "README.md":
        return path.parent.name if path.parent.name == "bench" else "index"
    return path.stem.lower()


def section_of(page, anchor):
    """The name of a section, by the anchor that links to it."""
    return f"{page}-{anchor}"


def anchor_of(heading):
    """As those who show Markdown make it of a heading."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def link(match):
    text, target = match[1], match[2]
    if re.match(r"[a-z]+:", target) or target.endswith((".png", ".svg")):
        return match[0]
    path, _, anchor = target.partition("#")
    if not path.endswith(".md"):
        return text
    return f"[{text}](@ref {section_of(name_of(path), anchor) if anchor else name_of(path)})"


def code(match):
    """Doxygen ends code at an apostrophe, and at the end of a line."""
    text = re.sub(r"\s*\n\s*", " ", match[0])
    return f"`{text}`" if "'" in text else text


def prose(text):
    text = re.sub(r"(?<!!)\[([^\]]*)\]\(([^)\s]+)\)", link, text)
    text = re.sub(r"(?<!`)`[^`]+`(?!`)", code, text)
    text = re.sub(r"\*\*(\S[^*]*)\*\*", r"<b>\1</b>", text)
    # A word such as BM@N is no command.
    return "".join(part if i % 2 else re.sub(r"(\w)@(\w)", r"\1\\@\2", part)
                   for i, part in enumerate(re.split(r"(`[^`]*`)", text)))


def for_doxygen(path):
    parts = re.split(r"(^ *```.*?^ *```$)", Path(path).read_text(), flags=re.M | re.S)
    def heading(match):
        return f"{match[1]} {match[2]} {{#{section_of(name_of(path), anchor_of(match[2]))}}}"

    text = "".join(part if i % 2 else
                   prose(re.sub(r"^(##+) (.*)$", heading, part, flags=re.M))
                   for i, part in enumerate(parts))
    if name_of(path) != "index":
        text = re.sub(r"\A# (.*)$", lambda m: f"# {m[1]} {{#{name_of(path)}}}", text, flags=re.M)
    return text


def header_for_doxygen(path):
    return re.sub(r"^template <>\nstruct std::.*?^};", lambda m: "\n" * m[0].count("\n"),
                  Path(path).read_text(), flags=re.M | re.S)


if __name__ == "__main__":
    file = sys.argv[1]
    sys.stdout.write(for_doxygen(file) if file.endswith(".md") else header_for_doxygen(file))
