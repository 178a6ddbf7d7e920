# SPDX-License-Identifier: BSD-3-Clause
"""Cases, runs and equations of state of whipple for Python: `import whipple`, `from whipple import eos`
(docs/manual/python.md)."""
import os
import pathlib
import sys

# An installed module finds the material library of its own installation, as the installed program does.
_above = pathlib.Path(__file__).resolve().parents  # PREFIX/lib/python3/dist-packages/whipple/__init__.py
_library = _above[min(4, len(_above) - 1)] / "share" / "whipple" / "materials"
if _library.is_dir():
    os.environ.setdefault("WHIPPLE_MATERIALS", str(_library))


def _restored_material(file, changes, constants):
    """Read the material of a pickle again; a function of Python, as pickles name one by its module."""
    from whipple import eos
    return eos._restored_material(file, changes, constants)


class _Remedy:
    """Say what to do where the compiled module is missing: the last finder of imports, asked when no other has found it."""

    @staticmethod
    def find_spec(name, path=None, target=None):
        """Raise ImportError for the compiled module, and leave all others alone."""
        if name != f"{__name__}.eos":
            return None
        folder = pathlib.Path(__file__).resolve().parent
        built = sorted(path.name for path in folder.glob("eos.*.so"))
        if built:
            remedy = (f"it was built for another Python ({', '.join(built)}), this one is {sys.version.split()[0]} of "
                      f"{sys.executable}: use /usr/bin/python3")
        else:
            remedy = ("it is built by `cmake --build --preset release --target whipple_python_eos` in the source folder "
                      "(scripts/run.sh leaves it out) into build/release/python, which PYTHONPATH names")
        raise ImportError(f"whipple.eos is not in {folder}: {remedy} (docs/manual/python.md)", name=name)


sys.meta_path.append(_Remedy)

_RUNS = ("Case", "CaseError", "Fault", "Quantity", "Results", "Run", "RunError", "StudyResults", "Table", "materials",
         "program", "sweep")
__all__ = ["eos", *_RUNS]


def __getattr__(name):
    """Import the compiled module and that of runs on their first use."""
    import importlib
    if name in _RUNS:
        return getattr(importlib.import_module(f"{__name__}.runs"), name)
    if name != "eos":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    try:
        return importlib.import_module(f"{__name__}.eos")
    except ImportError as missing:  # hasattr() is to say no
        raise AttributeError(str(missing)) from missing
