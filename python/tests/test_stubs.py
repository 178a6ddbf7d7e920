# SPDX-License-Identifier: BSD-3-Clause
"""Test that the type stubs say what the module has: classes and their bases, properties, and the parameters of
functions as the module writes them into its docstrings. And that docstrings of quantities state units."""
import ast
import inspect
import pathlib
import re
import unittest

from whipple import eos

STUBS = pathlib.Path(eos.__file__).with_name("eos.pyi")
HIDDEN = {"__getitem__", "__len__"}  # special methods that users call


def public(owner):
    return {name for name in vars(owner) if not name.startswith("_") or name in HIDDEN}


def parameters_of_docstring(function):
    """Names of the parameters in order, "*" where keywords begin, "=" after those with a default."""
    head = function.__doc__.splitlines()[0]
    # Types may hold commas in brackets, defaults may hold braces.
    inside = head[head.index("(") + 1:head.rindex(") ->")]
    while re.search(r"[\[({][^\[\](){}]*[\])}]", inside):
        inside = re.sub(r"[\[({][^\[\](){}]*[\])}]", "", inside)
    names = []
    for part in filter(None, inside.split(", ")):
        name = part.split(":")[0].split("=")[0].strip()
        names.append(name + ("=" if "=" in part else ""))
    return names


def parameters_of_stub(node):
    a = node.args
    plain = [argument.arg for argument in a.args]
    first_default = len(plain) - len(a.defaults)
    names = [name + ("=" if i >= first_default else "") for i, name in enumerate(plain)]
    if a.kwonlyargs:
        names.append("*")
        names += [argument.arg + ("=" if default is not None else "")
                  for argument, default in zip(a.kwonlyargs, a.kw_defaults)]
    return names


class Stubs(unittest.TestCase):
    def setUp(self):
        self.tree = ast.parse(STUBS.read_text(encoding="utf-8"))
        self.classes = {node.name: node for node in self.tree.body if isinstance(node, ast.ClassDef)}
        self.functions = {node.name: node for node in self.tree.body if isinstance(node, ast.FunctionDef)}

    def test_same_names(self):
        self.assertEqual(set(self.classes) | set(self.functions), public(eos))

    def test_same_members_and_bases(self):
        for name, node in self.classes.items():
            kind = getattr(eos, name)
            bases = [ast.unparse(base).removeprefix("enum.") for base in node.bases]
            if bases == ["Enum"]:
                words = {target.id for line in node.body for target in line.targets}
                self.assertEqual(words, set(kind.__members__), name)
                continue
            own = [base.__name__ for base in kind.__bases__ if base.__name__ != "pybind11_object"]
            self.assertEqual(bases, own, name)
            stub = {line.name for line in node.body if isinstance(line, ast.FunctionDef)}
            self.assertEqual(stub, public(kind), name)
            for line in node.body:
                if isinstance(line, ast.FunctionDef):
                    is_property = any(ast.unparse(d) == "property" for d in line.decorator_list)
                    self.assertEqual(is_property, isinstance(vars(kind)[line.name], property), f"{name}.{line.name}")

    def test_same_parameters(self):
        for name, node in self.functions.items():
            self.assertEqual(parameters_of_stub(node), parameters_of_docstring(getattr(eos, name)), name)
        for kind, node in self.classes.items():
            for line in node.body:
                if isinstance(line, ast.FunctionDef) and not line.decorator_list:
                    function = getattr(getattr(eos, kind), line.name)
                    self.assertEqual(parameters_of_stub(line), parameters_of_docstring(function), f"{kind}.{line.name}")

    def test_docstrings_state_units(self):
        unitless = {"phase", "shape", "melted_fraction", "vaporised_fraction", "in_equilibrium"}
        for name in ("States", "Shocks", "Isentropes", "Releases", "Evaluation"):
            for member in public(getattr(eos, name)) - unitless - HIDDEN:
                text = inspect.getdoc(getattr(getattr(eos, name), member))
                self.assertRegex(text, r"kg/m\^3|J/kg|\bK\b|Pa\b|m/s|without unit", f"{name}.{member}")
        for name, node in self.functions.items():
            self.assertTrue(inspect.getdoc(getattr(eos, name)).strip(), name)


if __name__ == "__main__":
    unittest.main()
