#!/usr/bin/env python3
"""whole_program.py FORKED_RUNS RUNS [--seed N] [--first K] [--keep FOLDER]: randomly changed shipped files, read by
the program.

Run K takes a file of targets/shapes or targets/sweeps and changes keys, numbers, lines or bytes of it. Nine times
in ten it runs `check`, otherwise `simulate`, `export` or a search with a time limit of a second. Rules:
  - The exit code of `check` is 0 or 2; the other commands may also end with 3 or 4.
  - A run takes at most 20 s of processor time. Searches and states are run only if `check` expects them to be
    quick.
  - With code 2: one line on stderr, nothing on stdout, no file written.
  - Otherwise: JSON on stdout with finite numbers only.

The same seed and K give the same run. Inputs that break a rule are kept, and the exit code is 1 if any input did.
"""
import argparse
import collections
import json
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LONGEST_S = 20  # of processor time for one run: as long as a user would wait
QUICK_S = 3  # longest forecast of a search and its simulation that are run here
FEW_BODIES = 1500  # bodies of a sheet: the equilibrium of larger sheets takes up to a minute, as their files say
MEMORY = 4 << 30  # bytes of addresses, including those of the libraries: 2 GiB of data, which leaves the machine usable
STATES = ["exact", "exact", "equilibrium"]
FORMATS = ["stl", "3mf", "svg", "dxf", "scad", "glb", "mjcf"]
NUMBERS = ["0", "-1", "1", "2", "3", "0.5", "1e-300", "1e300", "-1e9", "1e9", "nan", ".inf", "2147483648", "90", "89.99", "-0.0", "1000000"]
WORDS = ["null", "[]", "{}", "true", "\"\"", "[1, 1]", "none", "~", "&a 1", "*a", "!!int 3", "x", "[[0, 0], [1, 0]]", "a: b"]


def seeds():
    files = sorted((SOURCE / "targets/shapes").glob("*.yaml")) + sorted((SOURCE / "targets/sweeps").glob("*.yaml"))
    return [(file.name, file.read_bytes()) for file in files]


def all_keys(files):
    return sorted({key for _, text in files for key in re.findall(r"[A-Za-z_]+(?=:)", text.decode())})


class Changer:
    def __init__(self, chance, files, keys):
        self.chance, self.files, self.keys = chance, files, keys

    def changed(self, text):
        for _ in range(self.chance.choice([1, 1, 2, 3, 5])):
            text = self.chance.choice([self.number, self.number, self.number, self.key, self.key, self.line, self.word, self.bytes])(text)
        return text

    def replaced(self, text, pattern, replacement):
        places = list(re.finditer(pattern, text))
        if not places:
            return text
        place = self.chance.choice(places)
        return text[:place.start()] + replacement(place.group()) + text[place.end():]

    def number(self, text):
        def other(old):
            how = self.chance.randrange(4)
            if how == 0:
                return self.chance.choice(NUMBERS).encode()
            try:
                value = float(old)
            except ValueError:
                return b"1"
            if how == 1:
                return str(int(value) + self.chance.choice([-2, -1, 1, 2, 10])).encode()
            return repr(value * self.chance.choice([-1, 0, 0.5, 2, 10, 0.1, 1.001])).encode()
        return self.replaced(text, rb"[-+]?\d+(\.\d+)?(e[-+]?\d+)?", other)

    def key(self, text):
        return self.replaced(text, rb"[A-Za-z_]+(?=:)", lambda old: self.chance.choice(self.keys).encode())

    def word(self, text):
        return self.replaced(text, rb"(?<=: )[^\n,{}]+", lambda old: self.chance.choice(WORDS + self.keys).encode())

    def line(self, text):
        lines = text.split(b"\n")
        at = self.chance.randrange(len(lines))
        how = self.chance.randrange(4)
        if how == 0:
            del lines[at]
        elif how == 1:
            lines.insert(at, self.chance.choice(lines))
        elif how == 2:
            lines.insert(at, self.chance.choice(self.chance.choice(self.files)[1].split(b"\n")))
        else:
            lines[at] = self.chance.choice([b"  " + lines[at], lines[at].strip()])
        return b"\n".join(lines)

    def bytes(self, text):
        if not text:
            return b"\xff"
        at = self.chance.randrange(len(text))
        length = self.chance.choice([0, 1, 1, 2, 8])
        new = bytes(self.chance.choice([self.chance.randrange(256), self.chance.choice(b"{}[],:-#'\"\n\t ")]) for _ in range(self.chance.randrange(3)))
        return text[:at] + new + text[at + length:]


def refuse_constant(name):
    raise ValueError("a number that is " + name)


class Program:
    """A kinetix-forked-runs process in a folder."""

    def __init__(self, program, folder):
        self.folder, self.input, self.out = folder, folder / "input.yaml", folder / "out"
        self.process = subprocess.Popen([program, str(LONGEST_S), str(MEMORY)], cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def run(self, arguments):
        """Returns the exit code, stdout and stderr. The code is None after LONGEST_S of processor time or too long
        by the clock."""
        shutil.rmtree(self.out, ignore_errors=True)
        self.process.stdin.write("\t".join([*arguments, "--quiet", "--threads", "1"]) + "\n")
        self.process.stdin.flush()
        code = int(self.process.stdout.readline())
        out, err = ((self.folder / name).read_bytes() for name in ("stdout", "stderr"))
        return None if -code in (signal.SIGXCPU, signal.SIGKILL, signal.SIGALRM) else code, out, err

    def fault(self, arguments, result, codes):
        """Describes the fault of a run; empty: none."""
        code, out, err = result
        if code is None:
            return f"over {LONGEST_S} s"
        if code not in codes:
            return f"exit code {code}: " + err.decode(errors="replace")[-300:]
        if code == 2:
            if err.count(b"\n") != 1 or len(err) < 2:
                return "not one line: " + err.decode(errors="replace")[:300]
            if self.out.exists():
                return "something is written, though the input is bad"
            return ""
        try:
            json.loads(out, parse_constant=refuse_constant)
        except (ValueError, UnicodeDecodeError) as error:
            return f"no JSON of finite numbers on stdout: {error}"
        return ""


def is_quick(out):
    expected = json.loads(out).get("expected", {})
    seconds = expected.get("search_s", 0) + expected.get("physics_s", 0)
    return seconds <= QUICK_S and expected.get("bodies", 0) <= FEW_BODIES


def other_command(chance, out):
    """Returns another command for a file that `check` accepts, or None if it would take long."""
    kind = json.loads(out)["kind"]
    if kind == "sweep" or not is_quick(out):
        return None
    if kind == "target":
        return ["input.yaml", "--no-verify", "--time-limit", "1", "--json", "-o", "out"]
    if chance.randrange(2):
        return ["simulate", "input.yaml", "--model", chance.choice(STATES), "--json", "-o", "out"]
    return ["export", "input.yaml", "--format", chance.choice(FORMATS), "--json", "-o", "out"]


def one_run(program, changer, chance):
    """Returns the arguments of the run and its fault."""
    program.input.write_bytes(changer.changed(chance.choice(changer.files)[1]))
    check = ["check", "input.yaml", "--json"]
    result = program.run(check)
    fault = program.fault(check, result, {0, 2})
    if fault or result[0] != 0 or chance.randrange(4):
        return check, result[0], fault
    more = other_command(chance, result[1])
    if not more:
        return check, result[0], ""
    result = program.run(more)
    return more, result[0], program.fault(more, result, {0, 2, 3, 4})


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("runs", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("failed_inputs"))
    asked = parser.parse_args()
    files = seeds()
    keys, counts, faults, began = all_keys(files), collections.Counter(), [], time.monotonic()
    with tempfile.TemporaryDirectory(prefix="kinetix-fuzz-") as name:
        folder = pathlib.Path(name)
        for shipped in ("targets/shapes", "targets/sweeps"):
            for file in (SOURCE / shipped).iterdir():
                (folder / file.name).symlink_to(file)
        program = Program(asked.program.resolve(), folder)
        for k in range(asked.first, asked.first + asked.runs):
            chance = random.Random(f"{asked.seed} {k}")
            words, code, fault = one_run(program, Changer(chance, files, keys), chance)
            command = words[0] if words[0] != "input.yaml" else "search"
            counts[f"{command}: {'over ' + str(LONGEST_S) + ' s' if code is None else code}"] += 1
            if fault:
                asked.keep.mkdir(parents=True, exist_ok=True)
                shutil.copy(program.input, asked.keep / f"{asked.seed}_{k}.yaml")
                faults.append(k)
                print(f"run {k}: {' '.join(words)}: {fault}", flush=True)
            if k % 1000 == 999:
                print(f"{k + 1 - asked.first} runs, {time.monotonic() - began:.0f} s, {len(faults)} faults", flush=True)
    print(f"{asked.runs} runs of seed {asked.seed} in {time.monotonic() - began:.0f} s: {len(faults)} faults")
    for what, count in sorted(counts.items()):
        print(f"  {count:7} {what}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
