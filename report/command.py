# SPDX-License-Identifier: BSD-3-Clause
"""Command line of the report."""
import argparse
import io
import pathlib
import sys

from report.comparison import Comparison
from report.errors import NotARun
from report.run import Run
from report.sections import Report


def parse_figure(text: str) -> tuple[str, pathlib.Path]:
    """Splits TITLE=FILE.png. Raises ArgumentTypeError if that is another text or there is no such file."""
    title, separator, path = text.partition("=")
    if not separator or not title:
        raise argparse.ArgumentTypeError(f"{text!r}: give TITLE=FILE.png")
    path = pathlib.Path(path)
    if not path.is_file():
        raise argparse.ArgumentTypeError(f"{path}: there is no such file")
    return title, path


def compare(arguments: argparse.Namespace) -> int:
    """Writes the page of several runs."""
    runs = [Run(folder) for folder in arguments.runs]
    output = pathlib.Path(arguments.output) if arguments.output else runs[0].output
    comparison = Comparison(runs, output, max(arguments.dpi, 20))
    comparison.add_all()
    print(comparison.write())
    return 0


def main(words: list[str] | None = None) -> int:
    """Writes report.html, its PNG files and metrics.json; of several runs comparison.html. Returns the exit code: 2 if a
    folder is that of no run."""
    parser = argparse.ArgumentParser(prog="report", description="Figures and tables of a run as one HTML page.",
                                     epilog="example: report RUN_DIR --figure 'Hugoniot of copper=hugoniot.png'")
    parser.add_argument("runs", metavar="RUN_DIR", nargs="+", help="folder that `whipple run` wrote; of several: a page "
                        "that compares them")
    parser.add_argument("--output", metavar="DIR", help="folder of the report (default: report/ in the first RUN_DIR)")
    parser.add_argument("--figure", metavar="TITLE=FILE.png", action="append", default=[], type=parse_figure,
                        help="a figure to show before the pictures (Hugoniot, isotherm, ...); may be repeated")
    parser.add_argument("--view", metavar="FILE.html", type=pathlib.Path, help="page of `whipple view` to show in this one")
    parser.add_argument("--dpi", metavar="N", type=int, default=300, help="dots per inch of the pictures (default 300)")
    arguments = parser.parse_args(words)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="surrogateescape")  # names of folders are printed as they are
    try:
        if len(arguments.runs) > 1:
            return compare(arguments)
        run = Run(arguments.runs[0], arguments.output)
        report = Report(run, max(arguments.dpi, 20))
        report.add_all(arguments.figure, arguments.view)
        print(report.write())
    except (NotARun, OSError) as error:
        print(f"report: error: {error}", file=sys.stderr)
        return 2
    return 0
