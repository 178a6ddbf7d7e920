#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prepare the pages of the site: the documents of the repository in their places, as Sphinx and MyST read them.

Usage: pages.py FOLDER [--python PATH] [--cpp]

FOLDER becomes the source folder of Sphinx. What differs from the documents: README.md is the first page; formulas are
typeset (formulas.py) and can be linked to; a link to a file that is no page is a download, one to a folder goes to the
README.md in it, or is plain text; docs/README.md gives the order of the pages. Made in addition: the index of the theory, its
sources, and the reference of the Python package from its stubs, with the docstrings of the modules below PATH.
Exit code 1, with the pages, if a page is neither in docs/README.md nor in a folder that one of its pages lists.
"""
import argparse
import html
import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import furo  # noqa: E402

import check_documents  # noqa: E402
import formulas  # noqa: E402
import python_reference  # noqa: E402
import sources  # noqa: E402

DOCUMENTS = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/**/*.md", "cases/**/README.md", "studies/**/README.md")
INDEX = "docs/README.md"
# Folders whose pages a page of the index leads to: not in the navigation, which every page repeats.
LISTED = ("docs/decisions", "docs/generated/results", "cases", "studies")
NORMALIZE = pathlib.Path("/usr/share/javascript/normalize.css/normalize.css")
KATEX = pathlib.Path("/usr/share/javascript/katex")
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\[\]]*\])*)\]\(([^)\s]+)\)")


def page_of(path):
    """Return the place of a document in the site."""
    name = path.relative_to(ROOT).as_posix()
    return "index.md" if name == "README.md" else name


def link(found, document, target):
    """Return a link of a document as it is in the site; files that are no pages are copied."""
    picture, text, address = found.groups()
    if re.match(r"[a-z]+:", address) or address.startswith("#"):
        return found.group(0)
    file, _, anchor = address.partition("#")
    other = (document.parent / file).resolve()
    if other.is_dir():
        other = other / "README.md"
    if not other.is_file() or not other.is_relative_to(ROOT):
        return text
    place = page_of(other)
    if other.suffix != ".md":
        (target / place).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(other, target / place)
    elif not any(other in ROOT.glob(pattern) for pattern in DOCUMENTS):
        return text
    up = "../" * page_of(document).count("/")
    return f"{picture}[{text}]({up or './'}{place}{'#' + anchor if anchor else ''})"


def typeset(lines):
    """Return the HTML of a block of formulas, none if it is no such block."""
    try:
        rows = formulas.rows(lines)
    except formulas.NoFormula:
        return None
    result = ['<div class="formulas">']
    for number, indent, text, tex in rows:
        name = f' id="eq-{number}"' if number else ""
        deep = " deep" if indent > 1 else ""
        shown = f'<span class="number">({number})</span>' if number else ""
        result.append(f'<div{name}><span class="tex{deep}" data-tex="{html.escape(tex)}">{html.escape(text)}</span>{shown}</div>')
    return result + ["</div>"]


def prepared(document, target):
    """Return the text of a document for Sphinx."""
    lines = document.read_text(encoding="utf-8").split("\n")
    result = []
    theory = document.parent == ROOT / "docs/theory"
    for kind, begin, end in check_documents.blocks(lines):
        block = lines[begin:end]
        if kind == "code" and theory and not block[0].strip().startswith(("```", "~~~")) and (made := typeset(block)):
            result += ["", *made, ""]
        elif kind in ("code", "formula"):
            result += block
        else:
            text = "\n".join(block)
            code = re.split(r"(`[^`]*`)", text)
            if any(LINK.search(part) for part in code[::2]) or "[`" in text:
                text = LINK.sub(lambda found: link(found, document, target), text)
            result.append(text)
    return "\n".join(result) + "\n"


def contents(names, caption="", depth=1):
    """Return a hidden table of contents of pages."""
    head = [f":caption: {caption}"] if caption else []
    return "\n".join(["", "```{toctree}", ":hidden:", f":maxdepth: {depth}", *head, "",
                      *(name.removesuffix(".md") for name in names), "```", ""])


def chapters():
    """Return {chapter: pages} of docs/README.md, in its order."""
    result, chapter = {}, ""
    for line in (ROOT / INDEX).read_text(encoding="utf-8").split("\n"):
        if line.startswith("## "):
            chapter = line[3:]
        for _, _, address in LINK.findall(line) if chapter else ():
            page = (ROOT / "docs" / address.partition("#")[0]).resolve()
            if page.suffix == ".md":
                result.setdefault(chapter, []).append(page_of(page))
    return result


def theory_index(pages):
    """Return the page that lists sections and numbered equations of the theory."""
    lines = ["# Index of the theory", "", "Sections and numbered equations of each page.", ""]
    for name in pages:
        text = (ROOT / name).read_text(encoding="utf-8").split("\n")
        for kind, begin, end in check_documents.blocks(text):
            line = text[begin]
            file = pathlib.Path(name).name
            if kind == "heading" and line.startswith("# "):
                lines += ["", f"## [{line[2:]}]({file})", ""]
            elif kind == "heading" and line.startswith("## "):
                lines.append(f"- [{line[3:]}]({file}#{check_documents.slug(line[3:])})")
            elif kind == "code" and typeset(text[begin:end]):
                numbers = [number for number, *_ in formulas.rows(text[begin:end]) if number]
                links = ", ".join(f'<a href="{file[:-3]}.html#eq-{number}">({number})</a>' for number in numbers)
                if links:
                    lines.append(f"  {links}" if lines[-1].lstrip().startswith(("-", "<")) else links)
    return "\n".join(lines) + "\n"


def write_assets(target):
    """Write the configuration and all files that pages load: nothing is fetched from elsewhere."""
    here, static = pathlib.Path(__file__).parent, target / "_static"
    shutil.copyfile(here / "conf.py", target / "conf.py")
    for folder in ("katex", "scripts", "styles"):
        (static / folder).mkdir(parents=True)
    for file, place in (("site.css", "site.css"), ("formulas.js", "formulas.js"), ("theme.js", "scripts/furo.js")):
        shutil.copyfile(here / file, static / place)
    for file in ("katex.min.css", "katex.min.js"):
        shutil.copyfile(KATEX / file, static / "katex" / file)
    shutil.copytree(KATEX / "fonts", static / "katex/fonts")
    # Debian's style sheet of the theme imports another one from the place that a web server of Debian has for it.
    style = (pathlib.Path(furo.__file__).parent / "theme/furo/static/styles/furo.css").read_text(encoding="utf-8")
    imported = NORMALIZE.read_text(encoding="utf-8")
    (static / "styles/furo.css").write_text(re.sub("@import url[^;]*;", lambda _: imported, style, count=1), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description="Prepares the pages of the site for Sphinx.")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--python", type=pathlib.Path, help="folder of the package whipple, whose docstrings are shown")
    parser.add_argument("--cpp", action="store_true", help="the site has the reference of the C++ headers in its folder cpp")
    arguments = parser.parse_args()
    target = arguments.folder
    shutil.rmtree(target, ignore_errors=True)
    documents = sorted({path for pattern in DOCUMENTS for path in ROOT.glob(pattern)})
    order = chapters()
    known = {name for pages in order.values() for name in pages} | {INDEX, "index.md"}
    lost = []
    for document in documents:
        name = page_of(document)
        text = prepared(document, target)
        if name not in known and name.startswith(tuple(folder + "/" for folder in LISTED)):
            text = "---\norphan: true\n---\n\n" + text
        elif name not in known:
            lost.append(name)
        if name == "docs/manual/library.md" and arguments.cpp:
            text += '\n<p><a href="../../cpp/index.html">Reference of the C++ headers</a></p>\n'
        if name == INDEX:
            text += contents(["/docs/theory/index", "/docs/theory/sources", "/docs/python_reference"])
        if name == "index.md":
            text += contents(["/" + INDEX], "Documentation")
            text += "".join(contents(["/" + page for page in pages], chapter) for chapter, pages in order.items())
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        (target / name).write_text(text, encoding="utf-8")
    (target / "docs" / "theory/index.md").write_text(theory_index(order["Theory"]), encoding="utf-8")
    theory = [(ROOT / name).read_text(encoding="utf-8") for name in order["Theory"]]
    (target / "docs" / "theory/sources.md").write_text(
        sources.page([(pathlib.Path(name).name, text.split("\n", 1)[0][2:], text) for name, text in zip(order["Theory"], theory)]),
        encoding="utf-8")
    (target / "docs" / "python_reference.md").write_text(python_reference.page(arguments.python), encoding="utf-8")
    write_assets(target)
    for name in lost:
        print(f"{name}: no page of the site leads to it: name it in {INDEX}")
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
