# SPDX-License-Identifier: BSD-3-Clause
"""The site as readers get it: built by its one command, every link and every file of every page is there, nothing is
fetched from elsewhere; in Chromium, where it is installed, each as wide as a screen and as a telephone, light and dark:
formulas are typeset, pictures show, nothing is wider than the page, the console is empty; the search finds a word
without a network.

Usage: site_pages.py ROOT FOLDER
"""
import html.parser
import pathlib
import shutil
import subprocess
import sys
import time
import urllib.parse

from checks import require
from chromium import SKIPPED, Browser, programs

ROOT, FOLDER = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
SIZES = ((1280, 900), (390, 844))  # px, of a screen and of a telephone
SCHEMES = ("light", "dark")
SHOWN = tuple(f"{name}.html" for name in ("index", "docs/theory/gray", "docs/generated/gallery", "docs/tutorials/first_impact",
                                          "docs/python_reference"))  # pictures of them are kept in FOLDER/pictures
CONTRAST = 4.5  # of text to its background: level AA of the Web Content Accessibility Guidelines
# What a page shows. Letters of formulas stand twice in it, once for programs that read aloud; code is shown as it is.
LOOK = r"""
const all = selector => [...document.querySelectorAll(selector)];
const page = document.documentElement;
const text = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
const raw = [];
while (text.nextNode()) {
  if (text.currentNode.parentElement.closest("script, style, code, pre, .katex")) continue;
  const found = text.currentNode.data.match(/\$[^$\n]{1,80}\$|\\(frac|sqrt|mathrm|text|rho|sum|left)\b/);
  if (found) raw.push(found[0]);
}
const channels = colour => colour.match(/[\d.]+/g).map(Number);
const luminance = colour => channels(colour).slice(0, 3).map(c => c / 255)
  .map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4).reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
const style = getComputedStyle(document.body);
const paper = luminance(style.backgroundColor), ink = luminance(style.color);
const over = page.scrollWidth - page.clientWidth;
return {
  formulas: all(".formulas .tex").length, typeset: all(".formulas .tex .katex").length, errors: all(".katex-error, merror").length, raw: raw,
  pictures: document.images.length, broken: [...document.images].filter(i => !i.naturalWidth).map(i => i.src),
  tables: all("table").length, over: over, width: window.innerWidth,
  wide: over > 0 ? all("body *").filter(e => e.getBoundingClientRect().right > page.clientWidth + 1).slice(0, 3).map(e => e.outerHTML.slice(0, 80)) : [],
  light: paper, contrast: (Math.max(paper, ink) + 0.05) / (Math.min(paper, ink) + 0.05),
};
"""


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
    """Open every page, wide and as narrow as a telephone, light and dark."""
    found = programs()
    if found is None:
        return
    profile = FOLDER / "profile"
    shutil.rmtree(profile, ignore_errors=True)
    shutil.rmtree(FOLDER / "pictures", ignore_errors=True)
    (FOLDER / "pictures").mkdir()
    pages = sorted(page.relative_to(site).as_posix() for page in site.rglob("*.html"))
    pages = [page for page in pages if not page.startswith("cpp/search/")]  # entries of Doxygen's search box, shown in a frame of it
    counted, faults = dict.fromkeys(("formulas", "pictures", "tables"), 0), []
    with Browser(*found, profile) as browser:
        for page in pages:
            browser.open((site / page).as_uri())
            browser.wait("return document.readyState === 'complete' && [...document.images].every(i => i.complete)", page)
            for width, height in SIZES:
                browser.command("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 500)
                for scheme in SCHEMES:
                    browser.command("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
                    browser.wait(f"return (document.body.dataset.theme ?? '{scheme}') === '{scheme}'", f"{page}: {scheme}")
                    seen = browser.js(LOOK)
                    where = f"{page}, {width} px, {scheme}"
                    faults += [f"{where}: {what}" for what in unlike(seen, width, scheme, written="cpp/" not in page)]
                    if page in SHOWN:
                        browser.js("document.querySelector('.formulas')?.scrollIntoView()")
                        browser.picture(FOLDER / "pictures" / f"{page[:-5].replace('/', '_')}_{width}_{scheme}.png")
            faults += [f"{page}: {told}" for told in browser.complaints()]
            for name in counted:
                counted[name] += seen[name]
        browser.open((site / "search.html").as_uri() + "?q=hourglass")
        browser.wait("return document.querySelectorAll('#search-results li').length > 0", "results of a search")
    require(counted["formulas"] > 400, f"{counted['formulas']} formulas")
    require(not faults, f"{len(faults)}:\n" + "\n".join(faults[:40]))
    print(f"{len(pages)} pages in Chromium, each {' and '.join(f'{width} px' for width, _ in SIZES)} wide, {' and '.join(SCHEMES)}: "
          f"{', '.join(f'{count} {name}' for name, count in counted.items())}; nothing is wider than the page; search")


def unlike(seen, width, scheme, written):
    """Return what is wrong with a page. @param written  whether it is a page of the documents, not of the C++ headers"""
    if seen["typeset"] != seen["formulas"] or seen["errors"]:
        yield f"{seen['typeset']} of {seen['formulas']} formulas are typeset, errors: {seen['errors']}"
    if seen["raw"]:
        yield f"TeX that is not typeset: {seen['raw'][:3]}"
    if seen["broken"]:
        yield f"pictures that do not show: {seen['broken']}"
    if seen["over"] > 0:
        yield f"{seen['over']} px wider than the page: {seen['wide']}"
    if seen["width"] != width:
        yield f"{seen['width']} px wide"
    if written and (seen["light"] > 0.5) != (scheme == "light"):
        yield f"background {seen['light']:.2f}"
    if written and seen["contrast"] < CONTRAST:
        yield f"text on its background: contrast {seen['contrast']:.1f}"


def main():
    cpp = [] if shutil.which("doxygen") else ["--no-cpp"]
    begin = time.monotonic()
    done = subprocess.run([ROOT / "scripts/site.sh", FOLDER, *cpp], stdout=subprocess.PIPE, text=True, check=False)
    print(done.stdout, end="")
    if done.returncode == SKIPPED:
        sys.exit(SKIPPED)
    require(done.returncode == 0, "the site is not built")
    print(f"built in {time.monotonic() - begin:.0f} s")
    pages, links = check_links(FOLDER / "html")
    require(pages > 100 and links > 10000, f"{pages} pages, {links} links")
    print(f"{pages} pages, {links} links and files are there")
    check_in_browser(FOLDER / "html")


main()
