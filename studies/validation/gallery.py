# SPDX-License-Identifier: BSD-3-Clause
"""The gallery, docs/generated/gallery.md: every case with its bodies at the start, what is compared with which verdict and
at what cost. Pictures are functions of the case files and of the stored results, as text (SVG)."""
from html import escape

from studies.validation import arrangement, bands, page
from studies.validation.cases import ROOT
from studies.validation.store import write_if_changed

PAGE = ROOT / "docs" / "generated" / "gallery.md"
PICTURES = ROOT / "docs" / "generated" / "gallery"
# Pictures of runs that are stored.
OF_RUNS = {"ceramic_penetration": "ceramic.png", "copper_disk_on_aluminium": "debris_cloud.png", "hanchak_concrete": "hanchak.png",
           "jet_into_steel": "jet_into_steel.png", "lead_sphere_on_plate_gray": "lead_cloud.png",
           "long_rod_oblique_plate": "long_rod.png", "ogive_rod_oblique_plate": "ogive_rod.png",
           "shaped_charge_81mm": "shaped_charge.png", "wave_shaper": "wave_shaper.png"}
COLOURS = ("#4477aa", "#cc6677", "#ddcc77", "#117733", "#88ccee", "#aa4499", "#999933", "#882255")  # Tol, colour-blind safe
OF_MARK = {bands.AGREES: "#117733", bands.DIFFERS: "#aa3344", bands.NOT_CONVERGED: "#bb8800"}
WIDTH, LEFT, ROW, MOST, REACH = 640, 300, 22, 10, 3.0
INTRODUCTION = """# Gallery

Every case: its bodies at the start in a section, drawn from the case file; what it is compared with, the verdict, and the
cost. In the charts a quantity is at (computed - expected)/tolerance with the bar of its numerical band; the tolerance of
what is expected is grey, arrows lie beyond the chart. Cost is the time of all runs that decide, finest cells included,
in seconds of one processor as recorded (threads times wall time). What verdicts mean: [results](results.md),
[uncertainty](../theory/uncertainty.md). Written by `scripts/results.py --write`.
"""


def text(x, y, words, size=12, anchor="start", colour="#222"):
    return f'<text x="{x:g}" y="{y:g}" font-size="{size}" text-anchor="{anchor}" fill="{colour}">{escape(words)}</text>'


def framed(height, lines):
    """Return an SVG of the width of all pictures."""
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height:g}" font-family="sans-serif">',
                      f'<rect width="{WIDTH}" height="{height:g}" fill="#fff"/>', *lines, "</svg>"]) + "\n"


def length(metres):
    """Return a length in the unit that reads best."""
    for unit, size in (("m", 1.0), ("mm", 1e-3), ("um", 1e-6)):
        if metres >= size:
            return f"{metres / size:.4g} {unit}"
    return f"{metres:.3g} m"


def section_picture(section):
    """Return the picture of the bodies of a case."""
    columns, rows = section.cells
    scale = min((WIDTH - 20) / columns, 300 / rows)
    left, top = (WIDTH - scale * columns) / 2, 8
    lines = [f'<g transform="translate({left:.4g} {top}) scale({scale:.5g})" shape-rendering="crispEdges">',
             f'<rect width="{columns}" height="{rows}" fill="#f4f4f4"/>']
    for body, x, y, width, height in section.rectangles:
        lines.append(f'<rect x="{x}" y="{y}" width="{width}" height="{height}" fill="{COLOURS[body % len(COLOURS)]}"/>')
    lines.append("</g>")
    below = top + scale * rows + 18
    x = 10
    for i, name in enumerate(section.bodies[:8]):
        lines += [f'<rect x="{x}" y="{below - 10:.4g}" width="10" height="10" fill="{COLOURS[i % len(COLOURS)]}"/>',
                  text(x + 14, round(below, 1), name)]
        x += 26 + 7 * len(name)
    lines.append(text(WIDTH - 10, round(below, 1),
                      f"{section.axes[0]} {length(section.width)}, {section.axes[1]} {length(section.height)}", anchor="end"))
    return framed(round(below + 10), lines)


def compared(case):
    """Return the quantities that the verdicts of a case rest on: of headlines first, in the order of the runs."""
    runs = sorted((run for run in case["runs"] if page.deciding(run)), key=lambda run: not run["headline"])
    return [(run, q) for run in runs for q in page.physics(run) if q["mark"] in OF_MARK and q["value"] is not None]


def place(q):
    """Return (distance from what is expected, half width of the band), both over the tolerance."""
    tolerance = q["tolerance"] if q["kind"] == "within" else abs(q["expected"])
    if not tolerance:
        return None
    return (q["value"] - q["expected"]) / tolerance, (q["u_num"] or 0.0) / tolerance


def chart(case):
    """Return the picture of the comparisons of a case."""
    shown = compared(case)
    centre, unit = LEFT + (WIDTH - LEFT - 110) / 2, (WIDTH - LEFT - 110) / 2 / REACH
    bottom = ROW * min(len(shown), MOST) + 8
    lines = [f'<rect x="{centre - unit:g}" y="4" width="{2 * unit:g}" height="{bottom - 8}" fill="#e4e4e4"/>',
             f'<line x1="{centre:g}" x2="{centre:g}" y1="4" y2="{bottom - 4}" stroke="#888"/>']
    for row, (_, q) in enumerate(shown[:MOST]):
        y = ROW * row + 4 + ROW / 2
        name = q["name"] if len(q["name"]) <= 44 else q["name"][:42] + "…"
        lines += [text(LEFT - 8, y + 4, name, anchor="end"),
                  text(WIDTH - 6, y + 4, page.shown(q["value"], q["unit"], 3), anchor="end")]
        at = place(q)
        if at is None:
            continue
        x, half = max(-REACH, min(REACH, at[0])), at[1]
        low, high = (max(-REACH, min(REACH, at[0] + side * half)) for side in (-1, 1))
        colour = OF_MARK[q["mark"]]
        lines.append(f'<line x1="{centre + unit * low:.4g}" x2="{centre + unit * high:.4g}" y1="{y:g}" y2="{y:g}" stroke="{colour}" stroke-width="2"/>')
        if abs(at[0]) > REACH:
            tip, back = centre + unit * x, centre + unit * x - (7 if x > 0 else -7)
            lines.append(f'<path d="M{tip:.4g} {y:g} L{back:.4g} {y - 5:g} L{back:.4g} {y + 5:g} Z" fill="{colour}"/>')
        else:
            lines.append(f'<circle cx="{centre + unit * x:.4g}" cy="{y:g}" r="4.5" fill="{colour}"/>')
    if len(shown) > MOST:
        lines.append(text(LEFT - 8, bottom + 8, f"and {len(shown) - MOST} more", anchor="end", colour="#666"))
        bottom += 16
    return framed(bottom, lines)


def cost(case):
    """Return the seconds of a processor that the deciding runs of a case took."""
    return sum(record["threads"] * record["wall_time"] for run in case["runs"] if page.deciding(run)
               for record in run["records"].values() if record["wall_time"] is not None)


def entry(name, title, case, found, left_out):
    """Return the lines of a case on the page. @param found  the pictures @param left_out  what the section does not show"""
    links = f"[case](../../cases/{name})"
    lines = [f"## {title}", ""]
    if name in OF_RUNS:
        lines += [f"![{title}](../images/{OF_RUNS[name]})", ""]
    if PICTURES / f"{name}.svg" in found:
        lines += [f"![bodies at the start](gallery/{name}.svg)", ""]
    if left_out:
        lines += [f"Not drawn: {', '.join(left_out)}.", ""]
    if case is None:
        return [*lines, f"No stored result: {links}.", ""]
    if PICTURES / f"{name}_compared.svg" in found:
        lines += [f"![comparisons](gallery/{name}_compared.svg)", ""]
    told = []
    for origin, heading in page.CLASSES_OF_PHYSICS.items():
        marks = [mark for _, mark in page.verdicts(case, origin)]
        if marks:
            told.append(f"{heading.lower()}: {page.counted(marks)}")
    verdict = "Compared with " + "; ".join(told) if told else "Recorded without a comparison"
    return [*lines, f"{verdict}. Cost {cost(case):.0f} s. {links}, [result](results/{name}.md).", ""]


def title_of(path):
    """Return the heading of the page of a case."""
    return path.read_text(encoding="utf-8").split("\n", 1)[0].removeprefix("# ")


def pages(results):
    """Return the page and its pictures by path."""
    lines, found = [INTRODUCTION], {}
    for folder in sorted(path.parent for path in (ROOT / "cases").glob("*/case.toml")):
        name, case = folder.name, results["cases"].get(folder.name)
        try:
            section = arrangement.section(folder / "case.toml")
            found[PICTURES / f"{name}.svg"], left_out = section_picture(section), section.left_out
        except arrangement.Unknown as why:
            left_out = [f"the bodies ({why})"]
        if case and compared(case):
            found[PICTURES / f"{name}_compared.svg"] = chart(case)
        lines += entry(name, case["title"] if case else title_of(folder / "README.md"), case, found, left_out)
    return {PAGE: "\n".join(lines).rstrip("\n") + "\n"} | found


def write(results):
    """Renew page and pictures that say something else than before; return their paths."""
    return [path for path, written in pages(results).items() if write_if_changed(path, written)]


def unlike(results):
    """Return (path, what is wrong) of the page and of pictures that are not those of the cases and stored results."""
    expected = pages(results)
    return [(path, "is not that of the cases and results") for path, written in expected.items()
            if not path.is_file() or path.read_text(encoding="utf-8") != written] + \
        [(path, "a picture of no case") for path in sorted(PICTURES.glob("*.svg")) if path not in expected]
