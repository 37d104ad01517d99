#!/usr/bin/python3
"""Searches every shipped target for every process, exports what it finds, and prints the table.

    print_table.py PROGRAM FOLDER [--only REGEX] [--process NAME ...] [--verify]

`cell_mm` is taken out of the target where it is only a size, so that the search chooses it. A row is `written` if the
search ends with 0 and `export` without options writes its files. It is `told` if the search ends with 3 and its problems
give keys that were searched, or the reason why there are none.
"""
import argparse
import glob
import json
import os
import re
import subprocess
import sys
import time

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SHAPES = os.path.join(SOURCE, "targets", "shapes")
longest_s = 300  # of one run of the program
PROCESSES = ["fdm", "sla", "sls", "polyjet"]


def without_cell_mm(text):
    """Takes `cell_mm` out of a target. Hinges with sizes need it: then it stays."""
    if "gap_mm" in text or "diameter_mm" in text:
        return text
    text = re.sub(r"^ +cell_mm: [\d.]+\n", "", text, flags=re.M)
    text = re.sub(r", cell_mm: [\d.]+|cell_mm: [\d.]+, |", "", text)
    return re.sub(r"structure:\n(?! )", "", text)


def run(program, *arguments, seconds=longest_s):
    try:
        done = subprocess.run([program, *arguments, "--quiet"], capture_output=True, text=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return 124, f"not through after {seconds} s"
    return done.returncode, (done.stdout + done.stderr).strip()


def targets(only, processes):
    """Yields name, text and processes of each shipped target whose name matches. A target of a laser has no others."""
    for file in sorted(glob.glob(os.path.join(SHAPES, "*.yaml"))):
        name = os.path.basename(file)[:-5]
        with open(file) as source:
            text = source.read()
        if not re.search(r"^target:", text, re.M) or not re.search(only, name):
            continue
        named = re.search(r"^process: (\w+)|^process: \{base: (\w+)", text, re.M)
        own = named and (named[1] or named[2])
        yield name, text, [own] if own and own not in PROCESSES else processes


def write_target(folder, name, text):
    """Writes a target beside the files that it names. Returns its path."""
    os.makedirs(folder, exist_ok=True)
    for file in glob.glob(os.path.join(SHAPES, "*.*")):
        link = os.path.join(folder, os.path.basename(file))
        if not os.path.lexists(link) and not file.endswith(".yaml"):
            os.symlink(file, link)
    target = os.path.join(folder, name + "_goal.yaml")
    with open(target, "w") as out:
        out.write(text)
    return target


def errors_of(results):
    """Returns the errors of a result's verdict."""
    with open(os.path.join(results, "result.json")) as file:
        problems = json.load(file)["verdict"]["problems"]
    return "; ".join(p["text"] for p in problems if p["level"] == "error")


def row(program, name, text, process, folder, verify):
    target = write_target(folder, name, text)
    results = os.path.join(folder, name + "_" + process)
    start = time.monotonic()
    code, said = run(program, target, "--process", process, "-o", results, *([] if verify else ["--no-verify"]))
    seconds = time.monotonic() - start
    if code not in (0, 3, 4):
        return code, None, seconds, said.splitlines()[-1] if said else ""
    why = errors_of(results)
    exported, refused = run(program, "export", results, "--format", "stl", "-o", results + "_print")
    return code, exported, seconds, why or (refused if exported else "")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program")
    options.add_argument("folder")
    options.add_argument("--only", default="")
    options.add_argument("--process", nargs="+", default=PROCESSES)
    options.add_argument("--verify", action="store_true", help="with the simulation of each search")
    given = options.parse_args()
    written = rows = told = 0
    for name, text, processes in targets(given.only, given.process):
        for process in processes:
            code, exported, seconds, why = row(given.program, name, without_cell_mm(text), process, given.folder,
                                               given.verify)
            rows += 1
            written += code == 0 and exported == 0
            told += code == 3
            print(f"{name:16} {process:8} search {code} export {exported} {seconds:6.1f} s  {why[:300]}", flush=True)
    print(f"{rows} rows: {written} written, {told} end with 3, {rows - written - told} others")
    return 0


if __name__ == "__main__":
    sys.exit(main())
