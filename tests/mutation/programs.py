"""Builds the test programs with errors. Only sources that contain errors are compiled again."""
import json
import pathlib
import re
import shlex
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
ROOMS = ("model", "optim", "sim")


class Programs:
    """The programs of the build folder `build`. New files go to `scratch`."""

    def __init__(self, root, build, scratch):
        self.root, self.build, self.scratch = root, build, scratch
        rules = json.loads(self.ninja("compdb"))
        self.units = [rule for rule in rules if rule["output"].split("/")[0] in ROOMS and rule["file"].endswith(("cpp", "cxx"))]
        self.recorder_rule = next(rule for rule in rules if "kinetix_test_headers" in rule["output"] and rule["file"].endswith(".cpp"))

    def ninja(self, *tool):
        return subprocess.run(["ninja", "-C", self.build, "--quiet", "-t", *tool], check=True, capture_output=True, text=True).stdout

    def instrumented(self, path):
        return self.scratch / "sources" / path

    def write(self, path, text):
        """Writes a file if its content differs, so that unchanged files are not compiled again."""
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists() or path.read_text() != text:
            path.write_text(text)

    def compile(self, rule, source, target):
        """Compiles a source. @return the compiler's message if it fails"""
        words = shlex.split(rule["command"].split(" && ")[0])
        for option, value in (("-o", target), ("-c", source), ("-MF", f"{target}.d"), ("-MT", target)):
            words[words.index(option) + 1] = str(value)
        words[-2:-2] = ["-include", str(HERE / "mutation.hpp")]
        target.parent.mkdir(parents=True, exist_ok=True)
        run = subprocess.run(words, cwd=self.build, capture_output=True, text=True)
        return run.stderr if run.returncode else ""

    def sources_of(self, rule):
        """Returns the sources that a rule compiles, alone or joined."""
        file = pathlib.Path(rule["file"])
        if file.suffix == ".cpp":
            return [file]
        return [pathlib.Path(name) for name in re.findall(r'#include "(.*)"', file.read_text())]

    def compile_all(self, paths):
        """Compiles every unit with one of the paths. @return (objects, errors of the compiler)"""
        objects, refusals = [], ""
        for rule in self.units:
            sources = [source.relative_to(self.root) for source in self.sources_of(rule)]
            if not any(str(source) in paths for source in sources):
                continue
            unit = self.scratch / "units" / (rule["output"].replace("/", "_") + ".cxx")
            self.write(unit, "".join(f'#include "{self.instrumented(source) if str(source) in paths else self.root / source}"\n'
                                     for source in sources))
            target = self.scratch / "objects" / pathlib.Path(rule["output"]).parts[0] / unit.with_suffix(".o").name
            refusals += self.compile(rule, unit, target)
            objects.append(target)
        return objects, refusals

    def link(self, name, objects):
        """Links a program with its original command. The objects come before their rooms' libraries, which define
        the same names."""
        recorder = self.scratch / "objects" / "recorder.o"
        refusal = self.compile(self.recorder_rule, HERE / "recorder.cpp", recorder)
        if refusal:
            raise RuntimeError(refusal)
        command = next(line for line in self.ninja("commands", "-s", f"bin/{name}").splitlines() if f"-o bin/{name}" in line)
        words = shlex.split(command.removeprefix(": && ").split(" && ")[0])
        at = words.index("-o")
        program = self.scratch / name
        own = [str(target) for target in objects if f"{target.parent.name}/libkinetix_{target.parent.name}.a" in words]
        words[at:at + 2] = ["-o", str(program), str(recorder), *own]
        subprocess.run(words, cwd=self.build, check=True)
        return program
