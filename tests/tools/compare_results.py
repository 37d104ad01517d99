#!/usr/bin/python3
"""Compares the results of two builds of kinetix-opt.

    compare_results.py run PROGRAM FOLDER        runs all of targets into FOLDER: searches, found designs, shipped
                                                 designs, sweeps and imports.
    compare_results.py compare BEFORE AFTER      compares two such folders; exit code 1 if anything differs

Compared are exit codes, messages, console output, numbers and texts of results, their order, design.yaml and exported
files. Times, versions and paths are not. `--reworded` compares only the numbers of texts.

`--only REGEX` selects names that match, `--tolerance T` (1e-12) is relative for numbers above 1 and absolute below,
`--jobs N` (1) runs N programs at once.
"""
import argparse
import csv
import hashlib
import json
import math
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# Keys with times and versions.
TIMES = re.compile(r"^(timing_s|seconds|seconds_.*|.*_seconds|.*_per_second|per_second|rate|kinetix_version|"
                   r"threads|processes|started|written)$")
MOST_DIFFERENCES_SHOWN = 5
# Reports are pages made from result.json. The others are internal files of the program.
NOT_COMPARED = re.compile(r"^(report\.html|sweep\.sqlite|\..*)$")
MODELS = ("exact", "equilibrium", "bullet")


def runs():
    """Yields a name and the argument lists of its runs in their order; OUT is the folder of that name."""
    targets = os.path.join(SOURCE, "targets")

    def simulations(design):
        return [["simulate", "--model", model, design, "-o", f"OUT/{model}"] for model in MODELS]

    def export(design):
        return ["export", design, "--format", "3mf", "-o", "OUT/export"]

    for folder in ("shapes", "sweeps"):
        for name in sorted(os.listdir(os.path.join(targets, folder))):
            path = os.path.join(targets, folder, name)
            if not name.endswith(".yaml"):
                continue
            text = open(path).read()
            stem = f"{folder}/{os.path.splitext(name)[0]}"
            if re.search(r"^factors:", text, re.M):
                yield stem, [["sweep", path, "-o", "OUT"]]
            elif re.search(r"^target:", text, re.M):
                yield stem, [[path, "-o", "OUT"], *simulations("OUT/design.yaml"),
                             export("OUT/design.yaml")]
            else:
                yield stem, [*simulations(path), export(path)]
    yield "bodies/finger", simulations(os.path.join(targets, "sweeps/finger/design.yaml"))
    for name in ("squares", "vault"):
        yield f"imports/{name}", [["import", os.path.join(targets, "tiles", name), "-o", "OUT"],
                                  *simulations("OUT/design.yaml")]
    yield "imports/two_plates", [["import", "OUT/plates.obj", "--unit", "mm", "-o", "OUT"],
                                 *simulations("OUT/design.yaml"), export("OUT/design.yaml")]


def write_plates(path):
    """Writes an OBJ of two hard plates with a soft joint between them."""
    with open(path, "w") as file:
        for k, (name, x, length) in enumerate((("hard", 0, 20), ("soft", 20, 1), ("hard", 21, 20))):
            file.write(f"o {name}_{k}\nusemtl {name}\n")
            for corner in range(8):
                file.write(f"v {x + length * (corner & 1)} {10 * (corner >> 1 & 1)} {2 * (corner >> 2)}\n")
            for face in ((1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)):
                file.write("f " + " ".join(str(8 * k + corner) for corner in face) + "\n")


def run(program, out, only, jobs):
    def one(named):
        name, calls = named
        target = os.path.abspath(os.path.join(out, name))
        os.makedirs(target, exist_ok=True)
        done = []
        for call in calls:
            call = [part.replace("OUT", target) for part in call]
            if call[1].endswith("plates.obj"):
                write_plates(call[1])
            if call[0] == "export" and not os.path.exists(call[1]):
                continue
            ended = subprocess.run([program, *call, "--quiet"], capture_output=True, text=True)
            done.append({"exit": ended.returncode, "error": without_paths(ended.stderr, target),
                         "console": without_paths(ended.stdout, target).splitlines()})
        # A code of 2 may be the right answer (no closed form), so it is compared as a number.
        with open(os.path.join(target, "runs.json"), "w") as file:
            json.dump(done, file, indent=1)
        return f"{name}: exit {', '.join(str(d['exit']) for d in done)}"

    with ThreadPoolExecutor(jobs) as pool:
        for line in pool.map(one, [named for named in runs() if re.search(only, named[0])]):
            print(line, flush=True)


def without_paths(text, target):
    """Removes folders, which differ from run to run."""
    return text.replace(target, "OUT").replace(SOURCE, "")


def differences(a, b, tolerance, reworded, place=""):
    """Yields "place: a, b" for every number or text that differs."""
    if isinstance(a, dict) and isinstance(b, dict):
        for key in list(a) + [k for k in b if k not in a]:
            if TIMES.match(key):
                continue
            if key not in a or key not in b:
                yield f"{place}.{key}: only {'after' if key not in a else 'before'}"
            else:
                yield from differences(a[key], b[key], tolerance, reworded, f"{place}.{key}")
    elif isinstance(a, list) and isinstance(b, list):
        if len(a) != len(b):
            yield f"{place}: {len(a)} entries, then {len(b)}"
        for k, (x, y) in enumerate(zip(a, b)):
            yield from differences(x, y, tolerance, reworded, f"{place}[{k}]")
    elif isinstance(a, (int, float)) and isinstance(b, (int, float)) and not isinstance(a, bool):
        same = a == b or (math.isnan(a) and math.isnan(b))
        if not same and not abs(a - b) <= tolerance * max(1, abs(a), abs(b)):
            yield f"{place}: {a!r}, then {b!r}"
    elif isinstance(a, str) and isinstance(b, str):
        yield from text_differences(a, b, tolerance, reworded, place)
    elif a != b:
        yield f"{place}: {a!r}, then {b!r}"


CLOCK = re.compile(r"\b[\d.]+(e[+-]?\d+)? (s|ms|min|h|a second|per second)\b")  # in sentences
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")


def text_differences(a, b, tolerance, reworded, place):
    """Compares the words exactly, unless reworded, and the numbers in them to the tolerance."""
    a, b = (CLOCK.sub("TIME", text) for text in (a, b))
    if a == b:
        return
    x, y = ([float(n) for n in NUMBER.findall(text)] for text in (a, b))
    same_words = reworded or NUMBER.sub("N", a) == NUMBER.sub("N", b)
    if not same_words or len(x) != len(y) or any(
            not abs(p - q) <= tolerance * max(1, abs(p), abs(q)) for p, q in zip(x, y)):
        yield f"{place}: {a!r}, then {b!r}"


def table(path):
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text
    with open(path) as file:
        return [[value(cell) for cell in row] for row in csv.reader(file)]


def content(path):
    """Returns what a file says: a value to compare, or the bytes of files for other programs."""
    if path.endswith(".json"):
        return json.load(open(path))
    if path.endswith(".csv"):
        return table(path)
    if path.endswith(".yaml"):
        return open(path).read().splitlines()
    return hashlib.sha256(open(path, "rb").read()).hexdigest()


def compare(before, after, only, tolerance, reworded):
    def files_of(folder):
        return {os.path.relpath(os.path.join(inside, name), folder)
                for inside, _, names in os.walk(folder) for name in names if not NOT_COMPARED.search(name)}

    labels = sorted(label for label in files_of(before) | files_of(after) if re.search(only, label))
    wrong = 0
    for label in labels:
        first, second = os.path.join(before, label), os.path.join(after, label)
        missing = next((folder for folder, path in ((before, first), (after, second)) if not os.path.exists(path)), None)
        found = [f"missing in {missing}"] if missing else list(
            differences(content(first), content(second), tolerance, reworded))
        if found:
            wrong += 1
            print(f"{label}: {len(found)} differ")
            for line in found[:MOST_DIFFERENCES_SHOWN]:
                print("   ", line[:300])
    print(f"{len(labels)} files compared, {wrong} differ")
    if not labels:
        sys.exit("nothing to compare")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("verb", choices=["run", "compare"])
    parser.add_argument("first")
    parser.add_argument("second")
    parser.add_argument("--only", default="")
    parser.add_argument("--tolerance", type=float, default=1e-12)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--reworded", action="store_true")
    options = parser.parse_args()
    if options.verb == "run":
        run(os.path.abspath(options.first), options.second, options.only, options.jobs)
    elif compare(options.first, options.second, options.only, options.tolerance, options.reworded):
        sys.exit(1)


if __name__ == "__main__":
    main()
