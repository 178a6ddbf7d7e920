# SPDX-License-Identifier: BSD-3-Clause
"""scripts/torture.py removes no folder that it did not make."""
import importlib.util
import pathlib
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPEC = importlib.util.spec_from_file_location("torture", ROOT / "scripts" / "torture.py")
torture = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(torture)


class Folder(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def test_a_new_folder_is_made_and_one_of_an_earlier_call_made_again(self):
        made = self.folder / "new"
        torture.make_folder(made)
        (made / "run_000").mkdir()
        torture.make_folder(made)
        self.assertEqual([path.name for path in made.iterdir()], [torture.MARK])

    def test_a_folder_of_others_is_refused_and_stays(self):
        work = self.folder / "work"
        work.mkdir()
        (work / "thesis.tex").touch()
        link = self.folder / "link"
        torture.make_folder(self.folder / "made")
        link.symlink_to(self.folder / "made")
        for taken in (work, work / "thesis.tex", link):
            with self.assertRaises(ValueError, msg=taken):
                torture.make_folder(taken)
        self.assertTrue((work / "thesis.tex").exists())


if __name__ == "__main__":
    unittest.main()
