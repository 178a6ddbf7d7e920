# SPDX-License-Identifier: BSD-3-Clause
"""The papers and books that the theory cites, as one list with the places that cite them.

A citation is written where it is used: authors, journal, volume (year) first page, as "Nairn, CMES 10 (2005) 9".
"""
import re

NAME = r"(?:(?:[A-Z]\. ?)*(?:[Vv]an |[Dd]e |Le |von )?[A-Z][a-zA-Zé'ü-]+|et al\.)"
AUTHORS = rf"{NAME}(?:(?:, | and | & |, and ){NAME}| et al\.)*"
JOURNAL = r"(?:[A-Z0-9][\w.&-]*|of|in|and|for|the)(?: (?:[A-Z][\w.&-]*|of|in|and|for|the))*?"
CITATION = re.compile(rf"(?P<authors>{AUTHORS}),? (?:\((?=[A-Z]))?(?P<journal>(?:in [\w ]+, )?{JOURNAL}) (?P<volume>[A-Z]?\d+[A-Z]?) \((?P<year>(?:19|20)\d\d)\) (?P<page>[A-Z]?\d+)")


def cited(text):
    """Yield (first author, year, whole citation) of each citation in a text."""
    for found in CITATION.finditer(" ".join(text.split())):
        authors, rest = found["authors"], found[0][len(found["authors"]):].lstrip(", (")
        yield re.sub(r"^(?:[A-Z]\. ?)+", "", authors), found["year"], f"{authors}, {rest}"


def page(documents):
    """Return the list of sources. @param documents  (name, title, text) of each page"""
    places = {}
    for name, title, text in documents:
        for author, year, whole in cited(text):
            places.setdefault((author.lower(), year, whole), {})[name] = title
    lines = ["# Sources", "", "Papers that pages of the theory cite by journal, volume and page, and where.", ""]
    for key in sorted(places):
        lines.append(f"- {key[2]}: " + ", ".join(f"[{title}]({name})" for name, title in places[key].items()))
    return "\n".join(lines) + "\n"
