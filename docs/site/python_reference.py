# SPDX-License-Identifier: BSD-3-Clause
"""The reference of the Python package as a page: signatures from its stubs and sources, meanings from its docstrings."""
import ast
import importlib
import inspect
import pathlib
import sys

PACKAGE = pathlib.Path(__file__).resolve().parents[2] / "python/whipple"


def signature(node):
    """Return the signature of a function, without `self`."""
    node.args.args = [argument for argument in node.args.args if argument.arg not in ("self", "cls")]
    returned = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"{node.name}({ast.unparse(node.args)}){returned}"


def meaning(node, thing):
    """Return the docstring of a definition, of the module itself where the stub has none."""
    text = ast.get_docstring(node) or (inspect.getdoc(thing) if thing is not None else "") or ""
    lines = text.split("\n")
    if lines and "(" in lines[0] and "->" in lines[0]:  # pybind11 begins with the signature
        lines = lines[1:]
    return "\n".join(lines).strip().replace("<", "&lt;")


def entries(tree, module):
    """Yield the lines of all public definitions."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            yield from ("", f"### {node.name}", "", "```python", signature(node), "```", "",
                        meaning(node, getattr(module, node.name, None)))
        elif isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            owner = getattr(module, node.name, None)
            bases = ", ".join(ast.unparse(base) for base in node.bases)
            yield from ("", f"### {node.name}", "", f"Class, derived from `{bases}`." if bases else "Class.", "",
                        meaning(node, owner), "")
            for member in node.body:
                if not isinstance(member, ast.FunctionDef) or member.name.startswith("_"):
                    continue
                told = " ".join(meaning(member, getattr(owner, member.name, None)).split())
                is_property = any(isinstance(mark, ast.Name) and mark.id == "property" for mark in member.decorator_list)
                shown = f"{member.name}: {ast.unparse(member.returns)}" if is_property and member.returns else signature(member)
                yield f"- `{shown}`" + (f": {told}" if told else "")


def page(built):
    """Return the page. @param built  folder of the built package; without it the meanings of the compiled module are left out"""
    compiled = None
    if built is not None:
        sys.path.insert(0, str(built))
        compiled = importlib.import_module("whipple.eos")
    lines = ["# Python reference", "", "Signatures and meanings of the package `whipple`. How it is used:"
             " [Python](manual/python.md). All numbers are SI.", ""]
    for name, file, module in (("whipple", "runs.py", None), ("whipple.eos", "eos.pyi", compiled)):
        lines += ["", f"## {name}", "", *entries(ast.parse((PACKAGE / file).read_text(encoding="utf-8")), module)]
    if compiled is None:
        lines += ["", "Meanings of `whipple.eos`: `help(whipple.eos)`."]
    return "\n".join(lines) + "\n"
