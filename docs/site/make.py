"""Makes the site of docs/*.md and include/navjit, and checks it.

Usage: make.py SOURCE FOLDER VERSION DOXYGEN

It fails where Doxygen warns, Markdown is not understood, a link or an anchor leads nowhere, or a
document is not in the README's table, which is the site's table of contents. A document in
docs/NAME/ is linked from docs/NAME.md instead."""

import re
import shutil
import subprocess
import sys
from html import escape
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

from page import name_of

source, folder, version, doxygen = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), *sys.argv[3:5]
parts = sorted((source / "docs").glob("*/*.md"))
documents = [source / "CONTRIBUTING.md", source / "bench/README.md", *sorted((source / "docs").glob("*.md")), *parts]


def contents():
    """Titles and the names of their pages, by the rows of the README's last table."""
    text = (source / "README.md").read_text()
    rows = re.findall(r"^\| ([^|]+) \| (\[.*) \|$", text[text.index("## Documents"):], re.M)
    groups = [(title.strip(), [(t, name_of(p)) for t, p in re.findall(r"\[([^\]]*)\]\(([^)]*\.md)\)", links)])
              for title, links in rows]
    listed = {name for _, pages in groups for _, name in pages}
    missing = [d.name for d in documents if d not in parts and name_of(d) not in listed]
    if not groups or missing:
        sys.exit(f"make.py: not in the README's table: {', '.join(missing)}")
    return groups


def without_a_link():
    """Parts of a document that it does not lead to, and documents whose pages would have one name."""
    for part in parts:
        whole = part.parent.with_suffix(".md")
        if not whole.is_file() or f"]({part.parent.name}/{part.name}" not in whole.read_text():
            yield f"{part}: no link from docs/{whole.name} leads to it"
    names = [name_of(d) for d in documents]
    for document in documents:
        if names.count(name_of(document)) > 1:
            yield f"{document}: another document's page has the same name"


def layout():
    """Doxygen's own, but for the tree at the left."""
    tabs = ['<tab type="mainpage" visible="yes" title="navjit"/>']
    for title, pages in contents():
        tabs.append(f'<tab type="usergroup" visible="yes" title="{escape(title[0].upper() + title[1:])}">')
        tabs += [f'<tab type="user" url="@ref {name}" visible="yes" title="{escape(t[0].upper() + t[1:])}"/>'
                 for t, name in pages]
        tabs.append("</tab>")
    tabs += ['<tab type="usergroup" visible="yes" title="Programming interface">',
             '<tab type="classlist" visible="yes" title="Classes"/>',
             '<tab type="namespacemembers" visible="yes" title="Functions and types"/>',
             '<tab type="filelist" visible="yes" title="Headers"/>', "</tab>"]
    path = work / "layout.xml"
    subprocess.run([doxygen, "-l", path], check=True, stdout=subprocess.DEVNULL)
    text = re.sub(r"<navindex>.*</navindex>", lambda _: f"<navindex>{''.join(tabs)}</navindex>",
                  path.read_text(), flags=re.S)
    # Of private structs it has the heading in the summary, and nothing below.
    text = re.sub(r'<nestedclasses visible="yes"', '<nestedclasses visible="no"', text)
    path.write_text(text)
    return path


class Links(HTMLParser):
    def __init__(self, page):
        super().__init__()
        self.anchors, self.targets = set(), []
        self.feed(page.read_text(errors="replace"))

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if value is None:
                continue
            if key == "id" or (key == "name" and tag == "a"):
                self.anchors.add(value)
            elif key in ("href", "src"):
                self.targets.append(value)


def broken_links():
    pages = {page: Links(page) for page in folder.glob("*.html")}
    count = 0
    for page, links in pages.items():
        for target in links.targets:
            if re.match(r"([a-z]+:|//)", target) or target == "#":
                continue
            count += 1
            path, _, anchor = target.partition("#")
            to = (folder / unquote(path)).resolve() if path else page
            if not to.exists():
                yield f"{page.name}: {target} is not there"
            elif anchor and to in pages and unquote(anchor) not in pages[to].anchors:
                yield f"{page.name}: {target}: there is no such anchor"
    if count < 1000:
        yield f"only {count} links were found"


def left_markdown():
    """Signs of Markdown that Doxygen did not understand."""
    for document in documents:
        text = (folder / f"{name_of(document)}.html").read_text()
        text = re.sub(r'<(code|pre|script)\b.*?</\1>|<div class="line">.*?</div>', "", text, flags=re.S)
        for found in re.findall(r".{0,30}(?:\*\*|\]\(|`|@ref).{0,30}", re.sub(r"<[^>]*>", "", text)):
            yield f"{document}: not understood: {found}"


shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
work = folder.with_name(folder.name + "-parts")
shutil.rmtree(work, ignore_errors=True)
work.mkdir()
settings = (source / "docs/site/Doxyfile").read_text()
for key, value in {"SOURCE": source, "FOLDER": folder, "VERSION": version, "LAYOUT": layout(),
                   "PYTHON": sys.executable}.items():
    settings = settings.replace(f"@{key}@", str(value))
result = subprocess.run([doxygen, "-"], input=settings, text=True, stdout=subprocess.DEVNULL,
                        stderr=subprocess.PIPE)
problems = [line for line in result.stderr.splitlines() if line.strip()]
if result.returncode != 0:
    problems.append(f"{doxygen} ended with {result.returncode}")
problems += [f"{d}: it has no page" for d in documents if not (folder / f"{name_of(d)}.html").is_file()]
problems += [*without_a_link(), *broken_links(), *(left_markdown() if not problems else [])]
if problems:
    sys.exit("\n".join(problems).replace(f"{source}/", ""))
print(f"{folder}/index.html")
