#!/usr/bin/python3
"""Tells whether two builds of kinetix-opt give the same numbers.

    compare_results.py run PROGRAM FOLDER        runs every file of targets/shapes and targets/sweeps into FOLDER
    compare_results.py compare BEFORE AFTER      compares two such folders: every number of result.json, sweep.json
                                                 and samples.csv, times aside; exit code 1 if any differs

`--only REGEX` takes the files whose name matches, `--tolerance T` (1e-12) is relative for numbers above 1 and absolute
below, `--jobs N` (1) runs N programs at once.
"""
import argparse
import csv
import json
import math
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# What a clock measured, and what a release is called.
TIMES = re.compile(r"^(timing_s|seconds|seconds_.*|.*_seconds|.*_per_second|per_second|rate|kinetix_version|"
                   r"threads|processes|started|written)$")
MOST_DIFFERENCES_SHOWN = 5


def scenes(only):
    for folder in ("shapes", "sweeps"):
        path = os.path.join(SOURCE, "targets", folder)
        for name in sorted(os.listdir(path)):
            if not name.endswith(".yaml") or not re.search(only, name):
                continue
            text = open(os.path.join(path, name)).read()
            if re.search(r"^factors:", text, re.M):
                yield folder, name, ["sweep"]
            elif re.search(r"^target:", text, re.M):
                yield folder, name, []
            else:
                for model in ("exact", "equilibrium", "bullet"):
                    yield folder, name, ["simulate", "--model", model]


def run(program, out, only, jobs):
    def one(scene):
        folder, name, command = scene
        stem = os.path.splitext(name)[0] + ("_" + command[-1] if command[1:] else "")
        target = os.path.join(out, folder, stem)
        os.makedirs(target, exist_ok=True)
        call = [program, *command, os.path.join(SOURCE, "targets", folder, name), "-o", target, "--quiet"]
        done = subprocess.run(call, capture_output=True, text=True)
        # A code of 2 may be the right answer (no closed form): it is compared like a number.
        with open(os.path.join(target, "exit.json"), "w") as file:
            json.dump({"exit": done.returncode, "error": done.stderr.replace(SOURCE, "")}, file)
        return f"{folder}/{stem}: exit {done.returncode}"

    with ThreadPoolExecutor(jobs) as pool:
        for line in pool.map(one, list(scenes(only))):
            print(line, flush=True)


def differences(a, b, tolerance, place=""):
    """Yields "place: a, b" for every number or text that differs."""
    if isinstance(a, dict) and isinstance(b, dict):
        for key in list(a) + [k for k in b if k not in a]:
            if TIMES.match(key):
                continue
            if key not in a or key not in b:
                yield f"{place}.{key}: only {'after' if key not in a else 'before'}"
            else:
                yield from differences(a[key], b[key], tolerance, f"{place}.{key}")
    elif isinstance(a, list) and isinstance(b, list):
        if len(a) != len(b):
            yield f"{place}: {len(a)} entries, then {len(b)}"
        for k, (x, y) in enumerate(zip(a, b)):
            yield from differences(x, y, tolerance, f"{place}[{k}]")
    elif isinstance(a, (int, float)) and isinstance(b, (int, float)) and not isinstance(a, bool):
        same = a == b or (math.isnan(a) and math.isnan(b))
        if not same and not abs(a - b) <= tolerance * max(1, abs(a), abs(b)):
            yield f"{place}: {a!r}, then {b!r}"
    elif isinstance(a, str) and isinstance(b, str):
        yield from number_differences(a, b, tolerance, place)
    elif a != b:
        yield f"{place}: {a!r}, then {b!r}"


NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")


def number_differences(a, b, tolerance, place):
    """Of texts: words may change, the numbers in them may not."""
    if a == b:
        return
    x, y = ([float(n) for n in NUMBER.findall(text)] for text in (a, b))
    if len(x) != len(y) or any(not abs(p - q) <= tolerance * max(1, abs(p), abs(q)) for p, q in zip(x, y)):
        yield f"{place}: {a!r}, then {b!r}"


def table(path):
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text
    with open(path) as file:
        return [[value(cell) for cell in row] for row in csv.reader(file)]


def compare(before, after, only, tolerance):
    count = wrong = 0
    for folder, _, files in sorted(os.walk(before)):
        for name in sorted(files):
            if name not in ("result.json", "sweep.json", "samples.csv", "exit.json"):
                continue
            path = os.path.join(folder, name)
            label = os.path.relpath(path, before)
            if not re.search(only, label):
                continue
            count += 1
            other = os.path.join(after, label)
            if not os.path.exists(other):
                found = ["missing"]
            elif name.endswith(".csv"):
                found = list(differences(table(path), table(other), tolerance))
            else:
                found = list(differences(json.load(open(path)), json.load(open(other)), tolerance))
            if found:
                wrong += 1
                print(f"{label}: {len(found)} differ")
                for line in found[:MOST_DIFFERENCES_SHOWN]:
                    print("   ", line[:300])
    print(f"{count} files compared, {wrong} differ")
    if count == 0:
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
    options = parser.parse_args()
    if options.verb == "run":
        run(os.path.abspath(options.first), options.second, options.only, options.jobs)
    elif compare(options.first, options.second, options.only, options.tolerance):
        sys.exit(1)


if __name__ == "__main__":
    main()
