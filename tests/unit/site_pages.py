# SPDX-License-Identifier: BSD-3-Clause
"""The site as readers get it: built by its one command, every link and every file of every page is there, nothing is
fetched from elsewhere; in Chromium, where it is installed, formulas are typeset, nothing is wider than a telephone, and
the search finds a word without a network.

Usage: site_pages.py ROOT FOLDER
"""
import html.parser
import pathlib
import shutil
import subprocess
import sys
import urllib.parse

from checks import require
from chromium import SKIPPED, Browser, programs

ROOT, FOLDER = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
OPENED = ("index", "docs/theory/mpm", "docs/theory/gray", "docs/manual/input_reference", "docs/generated/results",
          "docs/theory/index", "docs/python_reference")


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.names, self.links, self.loads = set(), [], []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        of = dict(attributes)
        self.names |= {of[key] for key in ("id", "name") if of.get(key)}
        if tag == "a" and of.get("href"):
            self.links.append(of["href"])
        if tag in ("img", "script") and of.get("src") or tag == "link" and of.get("rel") == "stylesheet":
            self.loads.append(of.get("src") or of["href"])


def check_links(site):
    pages = {path.resolve(): Page(path) for path in site.rglob("*.html")}
    checked = 0
    for path, page in pages.items():
        for address in page.links + page.loads:
            parts = urllib.parse.urlsplit(address)
            if parts.scheme or parts.netloc:
                require(address not in page.loads or parts.scheme == "data", f"{path}: loads {address} from elsewhere")
                continue
            other = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            require(other.is_file(), f"{path}: nothing at '{address}'")
            require(not parts.fragment or other.suffix != ".html" or urllib.parse.unquote(parts.fragment) in pages[other].names,
                    f"{path}: no place '{address}'")
            checked += 1
    return len(pages), checked


def check_in_browser(site):
    found = programs()
    if found is None:
        return
    profile = FOLDER / "profile"
    shutil.rmtree(profile, ignore_errors=True)
    with Browser(*found, profile) as browser:
        for name in OPENED:
            browser.open((site / f"{name}.html").as_uri())
            browser.wait("return document.readyState === 'complete'", "the page")
            written, typeset = browser.js("return [document.querySelectorAll('.formulas .tex').length,"
                                          " document.querySelectorAll('.formulas .tex .katex').length]")
            require(written == typeset, f"{name}: {typeset} of {written} formulas are typeset")
            require(written > 20 or "theory/" not in name or name.endswith("index"), f"{name}: {written} formulas")
            require(not (faults := browser.complaints()), f"{name}: {faults}")
            broken = browser.js("return [...document.images].filter(i => !i.naturalWidth).map(i => i.src)")
            require(not broken, f"{name}: pictures that do not show: {broken}")
        browser.do("POST", "/window/rect", {"width": 500, "height": 900})
        for name in OPENED:
            browser.open((site / f"{name}.html").as_uri())
            over = browser.js("return document.documentElement.scrollWidth - window.innerWidth")
            require(over <= 0, f"{name}: {over} px wider than a telephone")
        browser.open((site / "search.html").as_uri() + "?q=hourglass")
        browser.wait("return document.querySelectorAll('#search-results li').length > 0", "results of a search")
    print(f"{len(OPENED)} pages in Chromium: formulas, pictures, width of a telephone, search")


def main():
    done = subprocess.run([ROOT / "scripts/site.sh", FOLDER, "--no-cpp"], stdout=subprocess.PIPE, text=True, check=False)
    print(done.stdout, end="")
    if done.returncode == SKIPPED:
        sys.exit(SKIPPED)
    require(done.returncode == 0, "the site is not built")
    pages, links = check_links(FOLDER / "html")
    require(pages > 100 and links > 10000, f"{pages} pages, {links} links")
    print(f"{pages} pages, {links} links and files are there")
    check_in_browser(FOLDER / "html")


main()
