# SPDX-License-Identifier: BSD-3-Clause
"""The page is whole and holds what it was given as text; files appear as a whole."""
import html
import pathlib
import re
import tempfile
import unittest

from report.files import write_whole
from report.page import Page


class Pages(unittest.TestCase):
    def test_texts_are_escaped_and_dollars_stay(self):
        page = Page("a < b", "$title & more")
        page.table(["x"], [["<td>"]], strong=(0,), text_columns=(0,))
        text = page.text()
        self.assertTrue(text.startswith("<!doctype html>") and text.endswith("</html>\n"))
        self.assertIn("<title>a &lt; b</title>", text)
        self.assertIn("$title &amp; more", text)
        self.assertIn("<tr class=strong><td class=text>&lt;td&gt;</td></tr>", text)
        self.assertIn(".tile b { display: block", text)

    def test_nothing_is_fetched_from_elsewhere(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "a.png"
            picture.write_bytes(b"PNG")
            page = Page("t", "s")
            page.image(picture.read_bytes(), "a picture")
        self.assertIn('<img src="data:image/png;base64,UE5H" alt="a picture">', page.text())
        self.assertNotIn("http", page.text())


    def test_a_page_within_the_page_keeps_its_text(self):
        page = Page("t", "s")
        page.frame('<p class="a">1 < 2 && "x"</p>', 'the "view"')
        found = re.search(r'<iframe class=view loading=lazy title="([^"]*)" srcdoc="([^"]*)"></iframe>', page.text())
        self.assertEqual(html.unescape(found.group(1)), 'the "view"')
        self.assertEqual(html.unescape(found.group(2)), '<p class="a">1 < 2 && "x"</p>')


class Files(unittest.TestCase):
    def test_a_file_that_fails_half_way_leaves_the_former_one(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "page.html"
            write_whole(path, lambda stream: stream.write(b"old"))

            def fail(stream):
                stream.write(b"new")
                raise OSError("disk full")

            with self.assertRaises(OSError):
                write_whole(path, fail)
            self.assertEqual(path.read_bytes(), b"old")
            self.assertEqual([entry.name for entry in path.parent.iterdir()], ["page.html"])
