#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Check the documents: links that resolve, lines of prose of at most 120 characters, no diary in the manual, the terms
of the glossary (docs/decisions/0005_language.md) in documents, comments and messages.

Usage: check_documents.py [ROOT]         check README.md, CONTRIBUTING.md, CHANGELOG.md, docs/ and cases/*/README.md
       check_documents.py --wrap FILE... fill the paragraphs of these files that are wider, in place
       check_documents.py --self-test    check that every rule finds its violation in a tree made for it

Tables, code, formulas and what a program writes (docs/generated, the input reference) may be wider. Exit code 1 with one
line for each fault.
"""
import pathlib
import re
import sys
import tempfile

WIDTH = 120
DOCUMENTS = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/**/*.md", "cases/**/README.md",
             "studies/**/README.md")
WRITTEN_BY_PROGRAMS = re.compile(r"docs/generated/|docs/manual/input_reference\.md")
TIMELESS = re.compile(r"((cases/.*/)?README\.md|CONTRIBUTING\.md|docs/(manual|theory)/.*)$")
SOURCES = (".cpp", ".hpp", ".py", ".sh", ".cmake", ".txt")
MONTH = "January|February|March|April|May|June|July|August|September|October|November|December"
DIARY = (
    ("date", re.compile(rf"\b\d{{1,2}}\.? ({MONTH})\b|\b({MONTH}) \d{{1,2}}\b|\b20\d\d-\d\d-\d\d\b")),
    ("time of day", re.compile(r"\b(morning|afternoon|evening|midnight)s?\b|\b(that|the same|later the) day\b"
                               r"|\b([01]?\d|2[0-3]):[0-5]\d\b", re.IGNORECASE)),
    ("commit hash", re.compile(r"(?<![\w.])(?=[0-9a-f]*\d)(?=[0-9a-f]*[a-f])(?!\d+e\d+\b)[0-9a-f]{7,40}\b"
                               r"|\b\d\de\d{4}\b")),
)
# Words of the glossary that have no other meaning here: (pattern, the term of the field).
BANNED = tuple((re.compile(pattern, re.IGNORECASE), term) for pattern, term in (
    (r"(?<!not )(?<!that )(?<!both )(?<!never )(?<!may )(?<!to )\b(?<!\ba )(?<!no )matter\b", "material"),
    (r"\bshares? of (the|its|their|a|an|this|what|rho|all|it)\b", "fraction of"),
    (r"\bspeed of sound\b", "sound speed"),
    (r"\bconduction of heat\b", "heat conduction"),
    (r"\btransfer heat\b|\bheat of the transfers?\b", "transfer dissipation"),
    (r"\bfor good\b(?! reason)", "permanently"),
    (r"\bbears? (shear|tension|pressure|stress)\b", "carries"),
    (r"\bloose material\b", "fragmented material"),
    (r"\bwanted (relative )?(standard )?error\b", "target error"),
    (r"\bguests of the grid\b", "off-grid points"),
    (r"\bborrowed (blocks|nodes)\b", "ghost blocks, ghost nodes"),
    (r"\bnodes in transition\b", "interface nodes"),
    (r"\blimit of compression\b", "volumetric strain-rate limit"),
    (r"\bdivision of (stretched )?particles\b", "particle splitting"),
    (r"\b(turned|turns|carried along) with the material\b", "rotated, convected with the material"),
    (r"\bwalls? that (matter|material) sticks to\b", "no-slip wall"),
    (r"\bin turns with version\b", "interleaved with version"),
    (r"\bdiameter of the foot\b", "diameter of the impact end"),
    (r"\banew\b", "again"),
    (r"\b(laid|lay|lays|set|sets|stands?) beside\b", "compared with, next to"),
    (r"\basks? (the|an) (equation of state|EOS)\b", "evaluates the equation of state"),
))
LANGUAGE_OF = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs", "cases", "src", "eos", "md_fitting", "python", "report", "scripts",
               "studies")
QUOTES_THE_GLOSSARY = ("docs/decisions/0005_language.md", "scripts/check_documents.py")
SPOKEN = re.compile(r'//[^\n]*|"(?:\\.|[^"\\\n])*"')  # comments and texts of a line of C++
ADDRESS = re.compile(r"https?://\S+|\]\([^)\s]*\)")
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
MENTION = re.compile(r"(?<![\w/.])docs/[\w/]+\.(?:md|json)\b")
ITEM = re.compile(r"(\s*)([-*+]|\d+[.)])\s+")
ITEM_IN_PARAGRAPH = re.compile(r"\s*([-*+]|1[.)])\s+")  # other numbers go on with the paragraph
STARTS_BLOCK = re.compile(r"([-*+]|\d+[.)])$|#|>|\|")


def blocks(lines):
    """Yield (kind, first, last) of runs of lines: prose, table, code, formula, heading, comment or blank."""
    i = 0
    in_list = False
    while i < len(lines):
        begin, text = i, lines[i].strip()
        if not text:
            kind = "blank"
            i += 1
        elif text.startswith(("```", "~~~")):
            kind = "code"
            i += 1
            while i < len(lines) and not lines[i].strip().startswith(text[:3]):
                i += 1
            i += 1
        elif text.startswith("$$"):
            kind = "formula"
            closed = len(text) > 3 and text.endswith("$$")
            i += 1
            while not closed and i < len(lines):
                closed = lines[i].strip().endswith("$$")
                i += 1
        elif text.startswith("<!--"):
            kind = "comment"
            while i < len(lines) and "-->" not in lines[i]:
                i += 1
            i += 1
        elif text.startswith("|"):
            kind = "table"
            while i < len(lines) and lines[i].strip().startswith("|"):
                i += 1
        elif re.match(r"#+ ", text):
            kind = "heading"
            i += 1
        elif lines[i].startswith("    ") and not in_list:
            kind = "code"
            while i < len(lines) and lines[i].startswith("    "):
                i += 1
        else:
            kind = "prose"
            numbered = re.match(r"\s*\d", lines[i]) and ITEM.match(lines[i])
            ends = ITEM if numbered or in_list else ITEM_IN_PARAGRAPH
            i += 1
            while i < len(lines) and lines[i].strip() and not ends.match(lines[i]) and \
                    not re.match(r"\s*(```|\||#+ |<!--|\$\$)", lines[i]) and not lines[i - 1].endswith("  "):
                i += 1
            in_list = bool(ITEM.match(lines[begin])) or (in_list and lines[begin].startswith("  "))
        if kind == "heading":
            in_list = False
        yield kind, begin, i
    return


def words(text):
    """Split prose at spaces outside of code and formulas: these are not broken over lines, unless they are long."""
    hidden = re.sub(r"`[^`]{,60}`|\$[^$\n]+\$", lambda match: match.group(0).replace(" ", "\0"), text)
    return [word.replace("\0", " ") for word in hidden.split()]


def fill(lines):
    """Fill one paragraph or list item to WIDTH; no line may begin with what would start a list or a table."""
    item = ITEM.match(lines[0])
    first = item.group(0) if item else re.match(r"\s*", lines[0]).group(0)
    rest = " " * len(first)
    hard_break = "  " if lines[-1].endswith("  ") else ""
    result = []
    line = []
    length = len(first)
    for word in words(" ".join([lines[0][len(first):], *lines[1:]])):
        if line and length + len(word) + (1 if line else 0) > WIDTH:
            carried = []
            while STARTS_BLOCK.match((carried or [word])[0]) and len(line) > 1:
                carried.insert(0, line.pop())
            result.append((rest if result else first) + " ".join(line))
            line = carried
            length = len(rest) + sum(len(part) + 1 for part in line) - (1 if line else 0)
        length += len(word) + (1 if line else 0)
        line.append(word)
    result.append((rest if result else first) + " ".join(line) + hard_break)
    return result


def wrap(text):
    """Return the document with those paragraphs filled that are too wide; all else as it is."""
    lines = text.split("\n")
    result = []
    for kind, begin, end in blocks(lines):
        wide = kind == "prose" and any(len(line) > WIDTH for line in lines[begin:end])
        result += fill(lines[begin:end]) if wide else lines[begin:end]
    return "\n".join(result)


def slug(heading):
    """Return the anchor that GitHub makes of a heading."""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")


def anchors(path):
    lines = path.read_text(encoding="utf-8").split("\n")
    return {slug(lines[begin].lstrip("#")) for kind, begin, _ in blocks(lines) if kind == "heading"}


def faults_of(root, path):
    """Yield the faults of one document as lines of text."""
    name = path.relative_to(root).as_posix()
    lines = path.read_text(encoding="utf-8").split("\n")
    by_program = bool(WRITTEN_BY_PROGRAMS.match(name))
    for kind, begin, end in blocks(lines):
        if kind in ("code", "formula", "blank"):
            continue
        for i in range(begin, end):
            where = f"{name}:{i + 1}"
            if kind == "prose" and len(lines[i]) > WIDTH and not by_program:
                yield f"{where}: {len(lines[i])} characters: scripts/check_documents.py --wrap {name}"
            plain = ADDRESS.sub("", lines[i])
            for what, pattern in DIARY if TIMELESS.match(name) and not by_program else ():
                if match := pattern.search(plain if what == "commit hash" else re.sub(r"`[^`]*`", "", plain)):
                    yield f"{where}: {what}: '{match.group(0)}'"
        text = re.sub(r"`[^`]*`|\$[^$]+\$", "", "\n".join(lines[begin:end]))
        for target in LINK.findall(text):
            if re.match(r"[a-z]+:", target):
                continue
            file, _, anchor = target.partition("#")
            other = (path.parent / file) if file else path
            if not other.exists():
                yield f"{name}:{begin + 1}: no file '{file}'"
            elif anchor and anchor not in anchors(other):
                yield f"{name}:{begin + 1}: no heading '#{anchor}' in '{file or name}'"


def faults_of_mentions(root):
    """Yield the pages that comments of sources and documents name and that do not exist."""
    folders = ("src", "eos", "md_fitting", "tests", "scripts", "report", "studies", "docs", "cases", "cmake")
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (*SOURCES, ".md") and path.is_file() and path.name != pathlib.Path(__file__).name:
                text = path.read_text(encoding="utf-8", errors="replace")
                for page in sorted(set(MENTION.findall(text))):
                    if not (root / page).exists():
                        yield f"{path.relative_to(root)}: names '{page}', which does not exist"


def faults_of_language(root):
    """Yield the words of the glossary's left column in documents, and in comments and texts of sources."""
    for name in LANGUAGE_OF:
        for path in [root / name] if (root / name).is_file() else sorted((root / name).rglob("*")):
            relative = path.relative_to(root).as_posix()
            if path.suffix not in (*SOURCES, ".md", ".toml") or not path.is_file() or relative in QUOTES_THE_GLOSSARY:
                continue
            for i, line in enumerate(path.read_text(encoding="utf-8", errors="replace").split("\n"), start=1):
                text = " ".join(SPOKEN.findall(line)) if path.suffix in (".cpp", ".hpp") else line
                for pattern, term in BANNED:
                    if match := pattern.search(text):
                        yield f"{relative}:{i}: '{match.group(0)}': the term is '{term}'"


def check(root):
    documents = sorted({path for pattern in DOCUMENTS for path in root.glob(pattern)})
    faults = [fault for path in documents for fault in faults_of(root, path)]
    return documents, faults + list(faults_of_mentions(root)) + list(faults_of_language(root))


def self_test():
    """Make a tree in which every rule is broken once, and a page in order."""
    long = "word " * 30
    pages = {
        "README.md": "# Top\n\nGood [page](docs/manual/good.md#a-heading-of-2), `12:30`, 1e-15, 2:1.\n",
        "docs/manual/good.md": f"# A heading of 2\n\n    {long}\n\n| {long} |\n\n```sh\n{long}\n```\n",
        "docs/manual/bad.md": f"{long}\n\nOn 25 November, version 8616de7, at 12:30.\n\nThe same day.\n\n"
                              "[no](none.md) [none](good.md#nothing)\n",
        "docs/decisions/0001_record.md": "Revision 8616de7 of 25 November.\n",
        "docs/generated/results.md": f"{long} on 4 May\n",
        "src/a.cpp": "// docs/theory/none.md\n",
        "src/b.cpp": '// Bodies share nodes; it does not matter.\nint matter = 1;\nf("hot matter");  // a share of the mass\n',
    }
    expected = ["characters", "date", "time of day", "commit hash", "time of day", "no file",
                "no heading", "does not exist", "'matter'", "'share of the'"]
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        for page, text in pages.items():
            (root / page).parent.mkdir(parents=True, exist_ok=True)
            (root / page).write_text(text, encoding="utf-8")
        _, found = check(root)
    wrong = [f"expected '{what}', found '{fault}'" for what, fault in zip(expected, found) if what not in fault]
    if len(found) != len(expected):
        wrong.append(f"{len(found)} faults instead of {len(expected)}: {found}")
    text = (f"See (1959)\n55) and {'b ' * 60}\n\n- {'a ' * 58}- b `code of words`\n  tail\n\n| t |\n| - |\n\n"
            "line one  \nline two\n")
    filled = wrap(text)
    if wrap(filled) != filled or any(len(line) > WIDTH for line in filled.split("\n")):
        wrong.append("filling is not idempotent, or too wide")
    if filled.split() != text.split() or re.search(r"^\s*- b", filled, re.MULTILINE) or "line one  \n" not in filled:
        wrong.append("filling changed words, made an item or lost a line break")
    return wrong


def main():
    arguments = sys.argv[1:]
    if arguments[:1] == ["--wrap"]:
        for name in arguments[1:]:
            path = pathlib.Path(name)
            text = path.read_text(encoding="utf-8")
            if (filled := wrap(text)) != text:
                path.write_text(filled, encoding="utf-8")
        return 0
    if arguments == ["--self-test"]:
        documents, faults = ["self-test"], self_test()
    elif arguments in (["--help"], ["-h"]):
        print(__doc__)
        return 0
    else:
        root = pathlib.Path(arguments[0]).resolve() if arguments else pathlib.Path(__file__).resolve().parents[1]
        if len(arguments) > 1 or not (root / "docs").is_dir():
            print(f"check_documents.py: error: {' '.join(arguments)}: expected the root of the project, --wrap FILE..., "
                  "--self-test or --help", file=sys.stderr)
            return 2
        documents, faults = check(root)
    for fault in faults:
        print(fault)
    print(f"documents: {len(documents)} read, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
