"""The examples of docs/how-to/python.md run as they stand there and print what stands there."""
import ast
import contextlib
import inspect
import io
import os
import re
import typing
import unittest

from support import SOURCE, Scratch

import kinetix

PAGE = (SOURCE / "docs/how-to/python.md").read_text()
EXAMPLES = re.findall(r"^```python\n(.*?)^```\n+```text\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)


class Documentation(Scratch):
    def test_there_are_five_examples_and_each_shows_its_output(self):
        self.assertEqual(len(EXAMPLES), 5)
        self.assertEqual(PAGE.count("```python\n"), len(EXAMPLES))

    def test_every_example_prints_as_on_its_page(self):
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        for number, (code, shown) in enumerate(EXAMPLES, 1):
            with self.subTest(example=number), contextlib.redirect_stdout(io.StringIO()) as printed:
                exec(compile(code, f"example {number} of docs/how-to/python.md", "exec"), {"__name__": "__main__"})
                self.assertEqual(printed.getvalue(), shown)

    def test_the_example_of_the_readme_runs(self):
        (code,) = re.findall(r"^```python\n(.*?)^```", (SOURCE / "README.md").read_text(), re.MULTILINE | re.DOTALL)
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            exec(compile(code, "example of README.md", "exec"), {"__name__": "__main__"})
        self.assertTrue(printed.getvalue().startswith("True 0"), printed.getvalue())
        self.assertTrue(os.path.exists("tray_print/print.json"))

    def test_everything_public_has_a_docstring_and_types(self):
        for name in kinetix.__all__:
            thing = getattr(kinetix, name)
            self.assertTrue(inspect.getdoc(thing), name)
            for member in public_functions(name, thing):
                self.check(*member)

    def test_the_stub_matches_the_compiled_part(self):
        stub = ast.parse((SOURCE / "python/kinetix/_core.pyi").read_text())
        said, there = {"version"}, set()
        for statement in stub.body:
            if isinstance(statement, (ast.FunctionDef, ast.ClassDef)):
                said.add(statement.name)
            for inner in statement.body if isinstance(statement, ast.ClassDef) else ():
                if isinstance(inner, (ast.FunctionDef, ast.AnnAssign)):
                    said.add(statement.name + "." + (inner.name if isinstance(inner, ast.FunctionDef) else inner.target.id))
        for name, thing in vars(kinetix._core).items():
            if name.startswith("_"):
                continue
            there.add(name)
            there.update(f"{name}.{inner}" for inner in (vars(thing) if inspect.isclass(thing) else ())
                         if not inner.startswith("_"))
        self.assertEqual(said, there)

    def check(self, name, function):
        self.assertTrue(inspect.getdoc(function), f"{name} has no docstring")
        parameters = [p for p in inspect.signature(function).parameters if p not in ("self", "cls")]
        hints = function.__annotations__
        self.assertEqual([p for p in parameters if p not in hints], [], name)
        self.assertIn("return", hints, name)
        typing.get_type_hints(function)  # names that can be found


def public_functions(name, thing):
    """Functions, methods and properties, with their names."""
    if inspect.isfunction(thing):
        yield name, thing
    for inner, member in vars(thing).items() if inspect.isclass(thing) else ():
        if inner.startswith("_") or issubclass(thing, tuple):
            continue
        if isinstance(member, property):
            member = member.fget
        member = getattr(member, "__func__", member)
        if inspect.isfunction(member):
            yield f"{name}.{inner}", member


if __name__ == "__main__":
    unittest.main()
