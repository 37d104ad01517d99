#!/usr/bin/python3
"""Searches panels for outlines, follows the cells that misses name, and prints the table. Exit code 1 if a share or ratio
is missed.

    outline_table.py PROGRAM FOLDER [--only REGEX] [--seconds S]            cells that are named (at least 70 % met)
    outline_table.py PROGRAM FOLDER --sides 8 12 16 20 [--only REGEX] ...   more cells (error at most 1.02 times)

FOLDER has point lists (CSV). Each is a target of kind outline with defaults. The first table counts outlines that are
met at once, or with the keys that the message of the miss names. The second one lists outline_rms for each number of
columns and rows, cut to the outline.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

LEAST_SHARE = 0.7
MOST_WORSE = 1.02  # ratio of errors


def search(program, points, structure, seconds):
    """Returns metrics and reasons of a search. `structure` is a section in YAML or empty."""
    with tempfile.TemporaryDirectory() as folder:
        target = pathlib.Path(folder) / "target.yaml"
        target.write_text(f"kinetix: 1\ntarget: {{kind: outline, points: {points.resolve()}}}\n{structure}\n")
        done = subprocess.run(
            [program, str(target), "--no-verify", "--json", "--quiet", "-o", f"{folder}/results"],
            capture_output=True, text=True, timeout=seconds, check=False)
    if done.returncode not in (0, 3):
        raise RuntimeError(f"{points.name}: {done.stderr.strip()}")
    result = json.loads(done.stdout)
    return result["metrics"], result["outline"]["reasons"], result["timing_s"]["optimise"]


def named_structure(reasons):
    """Returns the section that a miss names, or None."""
    found = re.search(r"With `(structure\..*?)` the goal is met", " ".join(reasons))
    if not found:
        return None
    keys = re.findall(r"structure\.(\w+): (\[.*?\]|\w+)", found[1])
    return f"structure: {{{', '.join(f'{key}: {value}' for key, value in keys)}}}"


def follow(program, points, seconds):
    """Prints a row. Returns whether the outline is met."""
    metrics, reasons, taken = search(program, points, "", seconds)
    structure = None if metrics["met"] else named_structure(reasons)
    row = f"| {points.stem} | {metrics['outline_rms']:.4f} / {metrics['iou']:.3f} "
    if structure:
        metrics, reasons, _ = search(program, points, structure, seconds)
    print(f"{row}| {structure or ''} | {metrics['outline_rms']:.4f} / {metrics['iou']:.3f} "
          f"| {'yes' if metrics['met'] else 'no'} | {taken:.1f} |", flush=True)
    return metrics["met"]


def compare_sides(program, points, sides, seconds):
    """Prints a row. Returns whether no error exceeds that of fewer cells by more than the ratio."""
    errors = []
    for side in sides:
        metrics, _, _ = search(program, points, f"structure: {{cells: [{side}, {side}]}}", seconds)
        errors.append(metrics["outline_rms"])
    is_good = all(error <= MOST_WORSE * min(errors[:k]) for k, error in enumerate(errors) if k)
    print(f"| {points.stem} | {' | '.join(f'{e:.4f}' for e in errors)} | {'yes' if is_good else 'no'} |", flush=True)
    return is_good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--sides", type=int, nargs="+")
    parser.add_argument("--seconds", type=float, default=600)
    options = parser.parse_args()
    outlines = [p for p in sorted(options.folder.glob("*.csv")) if re.search(options.only, p.stem)]
    if options.sides:
        print(f"| outline | {' | '.join(map(str, options.sides))} | never worse |")
        good = [compare_sides(options.program, p, options.sides, options.seconds) for p in outlines]
        print(f"{sum(good)} of {len(good)}")
        return 0 if all(good) else 1
    print("| outline | default: rms / overlap | named | with it: rms / overlap | met | search, s |")
    good = [follow(options.program, p, options.seconds) for p in outlines]
    print(f"{sum(good)} of {len(good)} met")
    return 0 if sum(good) >= LEAST_SHARE * len(good) else 1


if __name__ == "__main__":
    sys.exit(main())
