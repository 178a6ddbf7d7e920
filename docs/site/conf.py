# SPDX-License-Identifier: BSD-3-Clause
"""Configuration of Sphinx for the pages that docs/site/pages.py prepares (scripts/site.sh)."""
project = "whipple"
author = "The whipple authors"
copyright = author
extensions = ["myst_parser"]
myst_enable_extensions = ["deflist"]
myst_heading_anchors = 6
root_doc = "index"
html_theme = "furo"
html_title = "whipple"
html_static_path = ["_static"]
html_css_files = ["katex/katex.min.css", "site.css"]
html_js_files = ["katex/katex.min.js", "formulas.js"]
html_copy_source = False
html_show_sphinx = False
pygments_style = "friendly"
pygments_dark_style = "native"
highlight_language = "none"
nitpicky = True
