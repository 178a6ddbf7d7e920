# SPDX-License-Identifier: BSD-3-Clause
"""The stored results: docs/generated/results/<case>.json, one file per case, written only where it changed."""
import json

from studies.validation.cases import ROOT

FOLDER = ROOT / "docs" / "generated" / "results"


def load(folder=FOLDER):
    """Return what is stored of every case: {"cases": {name: study}}, by the names of the cases."""
    return {"cases": {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*.json"))}}


def write_if_changed(path, text):
    """Write a text, and return whether the file said something else before."""
    if path.is_file() and path.read_text(encoding="utf-8") == text:
        return False
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return True


def save(results, folder=FOLDER):
    """Write the cases whose study changed; return the paths of these files."""
    paths = {folder / f"{name}.json": study for name, study in results["cases"].items()}
    return [path for path, study in paths.items()
            if write_if_changed(path, json.dumps(study, indent=1, ensure_ascii=False) + "\n")]
