# SPDX-License-Identifier: BSD-3-Clause
"""One self-contained page: text, tables, figures embedded as base64."""
import base64
import html

STYLE = """
body { font: 16px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; color: #22262b; margin: 0; background: #f5f6f8; }
main { max-width: 1120px; margin: 0 auto; padding: 32px 28px 64px; background: #fff; box-shadow: 0 0 24px #0001; }
h1 { font-size: 30px; margin: 0 0 4px; line-height: 1.2; }
h2 { font-size: 21px; margin: 44px 0 12px; padding-bottom: 5px; border-bottom: 2px solid #d9dde3; }
.subtitle { color: #68707a; margin: 0 0 24px; }
figure { margin: 18px 0 26px; }
figure img { width: 100%; border: 1px solid #e3e6ea; border-radius: 4px; }
figcaption { color: #5c646e; font-size: 14px; margin-top: 4px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 14px; margin: 10px 0; }
th, td { padding: 5px 11px; border-bottom: 1px solid #e6e9ed; text-align: right; white-space: nowrap; }
th { background: #f1f3f6; font-weight: 600; }
th:first-child, td:first-child, td.text { text-align: left; }
td.text { white-space: normal; }
tr.strong td { font-weight: 600; border-top: 1px solid #c4cad2; }
.tiles { display: flex; flex-wrap: wrap; gap: 12px; margin: 20px 0; }
.tile { background: #f1f4f8; border-radius: 6px; padding: 10px 16px; min-width: 130px; }
.tile b { display: block; font-size: 20px; } .tile span { color: #68707a; font-size: 13px; }
details { margin: 14px 0; } summary { cursor: pointer; color: #2c5f9e; }
pre { background: #f6f7f9; padding: 14px; overflow-x: auto; font-size: 13px; line-height: 1.4; }
dt { font-weight: 600; } dd { margin: 0 0 6px 24px; color: #444b54; }
.note { background: #fff6df; border-left: 4px solid #e0a800; padding: 8px 14px; margin: 12px 0; }
"""


def escape(text):
    return html.escape(str(text))


class Page:
    def __init__(self, title, subtitle):
        self.title = title
        self.parts = [f"<h1>{escape(title)}</h1><p class=subtitle>{escape(subtitle)}</p>"]

    def heading(self, text):
        self.parts.append(f"<h2>{escape(text)}</h2>")

    def paragraph(self, text):
        self.parts.append(f"<p>{escape(text)}</p>")

    def note(self, text):
        self.parts.append(f"<p class=note>{escape(text)}</p>")

    def tiles(self, pairs):
        cells = "".join(f"<div class=tile><b>{escape(value)}</b><span>{escape(name)}</span></div>"
                        for name, value in pairs)
        self.parts.append(f"<div class=tiles>{cells}</div>")

    def table(self, head, rows, strong=(), text_columns=()):
        """`strong`: numbers of rows that stand out; `text_columns`: columns aligned to the left."""
        cells = "".join(f"<th>{escape(h)}</th>" for h in head)
        body = ""
        for i, row in enumerate(rows):
            line = "".join(f"<td{' class=text' if j in text_columns else ''}>{escape(c)}</td>"
                           for j, c in enumerate(row))
            body += f"<tr{' class=strong' if i in strong else ''}>{line}</tr>"
        self.parts.append(f"<div class=scroll><table><tr>{cells}</tr>{body}</table></div>")

    def definitions(self, pairs):
        items = "".join(f"<dt>{escape(name)}</dt><dd>{escape(text)}</dd>" for name, text in pairs)
        self.parts.append(f"<dl>{items}</dl>")

    def details(self, summary, text):
        self.parts.append(f"<details><summary>{escape(summary)}</summary><pre>{escape(text)}</pre></details>")

    def image(self, path, caption):
        data = base64.b64encode(path.read_bytes()).decode()
        self.parts.append(f'<figure><img src="data:image/png;base64,{data}" alt="{escape(caption)}">'
                          f"<figcaption>{escape(caption)}</figcaption></figure>")

    def text(self):
        return (f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{escape(self.title)}</title>'
                f'<meta name="viewport" content="width=device-width, initial-scale=1"><style>{STYLE}</style></head>'
                f"<body><main>{''.join(self.parts)}</main></body></html>\n")
