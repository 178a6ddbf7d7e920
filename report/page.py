# SPDX-License-Identifier: BSD-3-Clause
"""One self-contained page: text, tables, figures embedded as base64."""
import base64
import html
import pathlib
import string
from collections.abc import Collection, Iterable, Sequence

TEMPLATES = pathlib.Path(__file__).resolve().parent / "templates"

def escape(text: object) -> str:
    """Writes a value as text of HTML."""
    return html.escape(str(text))


class Page:
    """Collects the parts of a page, top down."""

    def __init__(self, title: str, subtitle: str):
        self.title = title
        self.parts = [f"<h1>{escape(title)}</h1><p class=subtitle>{escape(subtitle)}</p>"]

    def heading(self, text: str) -> None:
        """Adds the heading of a section."""
        self.parts.append(f"<h2>{escape(text)}</h2>")

    def paragraph(self, text: str) -> None:
        """Adds a paragraph."""
        self.parts.append(f"<p>{escape(text)}</p>")

    def note(self, text: str) -> None:
        """Adds a paragraph that stands out."""
        self.parts.append(f"<p class=note>{escape(text)}</p>")

    def tiles(self, pairs: Iterable[tuple[str, str]]) -> None:
        """Adds a row of pairs (name, value)."""
        cells = "".join(f"<div class=tile><b>{escape(value)}</b><span>{escape(name)}</span></div>"
                        for name, value in pairs)
        self.parts.append(f"<div class=tiles>{cells}</div>")

    def table(self, head: Sequence, rows: Iterable[Sequence], strong: Collection[int] = (),
              text_columns: Collection[int] = ()) -> None:
        """Adds a table. `strong`: numbers of rows that stand out; `text_columns`: columns aligned to the left."""
        cells = "".join(f"<th{' class=text' if j in text_columns else ''}>{escape(h)}</th>" for j, h in enumerate(head))
        body = ""
        for i, row in enumerate(rows):
            line = "".join(f"<td{' class=text' if j in text_columns else ''}>{escape(c)}</td>"
                           for j, c in enumerate(row))
            body += f"<tr{' class=strong' if i in strong else ''}>{line}</tr>"
        self.parts.append(f"<div class=scroll><table><tr>{cells}</tr>{body}</table></div>")

    def definitions(self, pairs: Iterable[tuple[str, str]]) -> None:
        """Adds a list of terms and their meanings."""
        items = "".join(f"<dt>{escape(name)}</dt><dd>{escape(text)}</dd>" for name, text in pairs)
        self.parts.append(f"<dl>{items}</dl>")

    def details(self, summary: str, text: str) -> None:
        """Adds a text that is folded away."""
        self.parts.append(f"<details><summary>{escape(summary)}</summary><pre>{escape(text)}</pre></details>")

    def image(self, png: bytes, caption: str, width: float = 1.0) -> None:
        """Adds a PNG file. `width`: share of that of the page."""
        data = base64.b64encode(png).decode()
        self.parts.append(f'<figure style="max-width: {100 * width:.4g}%">'
                          f'<img src="data:image/png;base64,{data}" alt="{escape(caption)}">'
                          f"<figcaption>{escape(caption)}</figcaption></figure>")

    def frame(self, page: str, title: str) -> None:
        """Adds a page that stands by itself, loaded when it comes into sight."""
        self.parts.append(f'<iframe class=view loading=lazy title="{escape(title)}" srcdoc="{escape(page)}"></iframe>')

    def text(self) -> str:
        """Returns the HTML of the page."""
        style = (TEMPLATES / "style.css").read_text(encoding="utf-8")
        page = string.Template((TEMPLATES / "page.html").read_text(encoding="utf-8"))
        return page.substitute(title=escape(self.title), style=style, body="".join(self.parts))
