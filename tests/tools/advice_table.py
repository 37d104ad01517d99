#!/usr/bin/python3
"""Follows all advice that searches give, or checks their drives, and prints the table. Exit code 1 if one does not work.

    advice_table.py PROGRAM FOLDER [--only REGEX] [--process NAME ...] [--seconds S]          follows advice
    advice_table.py PROGRAM FOLDER --drives [--only REGEX] [--process NAME ...] [--seconds S] simulates drives

Advice: each shipped target is searched with sizes that its process can hardly print (`variants`). If the search ends
with 3, the keys or the option that its errors and those of `export` name are applied, nothing else. Advice works if the
next search ends with 0 and `export` writes its files. `--cell-mm` works if `export` does.

Drives: where a search ends with 0 and names a drive, `simulate --model equilibrium` must fold its design with that drive
and the hinges that are printed. The bodies may be `tolerance.shape` of the target's diagonal from their places (rms).
"""
import argparse
import json
import os
import re
import sys

import numpy
import yaml

from print_table import PROCESSES, errors_of, run, targets, without_cell_mm, write_target

NO_DRIVE = "no drive"
usual_tolerance = 0.01  # of shapes, over the diagonal


def with_structure(goal, **keys):
    """Returns a target with other keys of `structure`. None takes a key out."""
    structure = {**(goal.get("structure") or {}), **keys}
    return {**goal, "structure": {key: value for key, value in structure.items() if value is not None}}


def variants(goal):
    """Yields name and target: as it is, and with sizes that many processes cannot print."""
    yield "shipped", goal
    if "hinge" in goal or "lattice" in (goal.get("structure") or {}):
        return  # sizes of hinges belong to their cells
    kind = goal["target"].get("kind") if isinstance(goal["target"], dict) else None
    yield "small", with_structure(goal, cell_mm=6, wall_mm=None, **({"cells": None} if kind == "space_curve" else {}))
    yield "thin", with_structure(goal, wall_mm={"thickness": 0.5, "height": 3})
    if kind in ("curve", "space_curve"):
        yield "many", with_structure(goal, cells=[36, 1], cell_mm=None, wall_mm=None)
    if kind == "outline":
        yield "many", with_structure(goal, cells=[12, 12], cell_mm=None, wall_mm=None)


def advice_of(errors, refusal):
    """Lists advice: ("keys", YAML of structure) or ("option", words of the command line)."""
    found = [("keys", keys) for keys in re.findall(r"with `structure: (\{.*?\})` the goal is met", errors)]
    found += [("keys", f"{{cells: {cells}}}") for cells in re.findall(r"a panel of (\[\d+, \d+\]) cells shows", errors)]
    found += [("option", option) for option in re.findall(r"[Gg]ive (--cell-mm [0-9.]+)", refusal)]
    return found


class Table:
    def __init__(self, given):
        self.given, self.rows, self.failed, self.not_run = given, 0, [], 0

    def run(self, *arguments):
        return run(self.given.program, *arguments, seconds=self.given.seconds)

    def search(self, name, goal, process):
        """Returns the exit code, what was printed, and the folder of the result."""
        file = write_target(self.given.folder, name, yaml.safe_dump(goal, sort_keys=False))
        results = os.path.join(self.given.folder, name)
        code, said = self.run(file, "--process", process, "--no-verify", "-o", results)
        if code == 124:
            self.not_run += 1
            print(f"{name:36} not through after {self.given.seconds:g} s", flush=True)
        return code, said, results

    def add(self, name, what, why):
        """@param why empty if it works"""
        self.rows += 1
        if why:
            self.failed.append(name)
        print(f"{name:36} {what:60} {'works' if not why else 'FAILS: ' + why[:300]}", flush=True)

    def end(self, what):
        print(f"{self.rows - len(self.failed)} of {self.rows} {what}; {self.not_run} runs not through in time")
        print(*[f"  {name}" for name in self.failed], sep="\n")
        return 1 if self.failed else 0


def follow(table, name, goal, process, results, advice):
    """Follows one advice. Returns why it does not work: empty if it does, None if it was not through in time."""
    kind, words = advice
    out = results + "_print"
    if kind == "option":
        code, said = table.run("export", results, "--format", "stl", "-o", out, *words.split())
        return "" if code == 0 else f"export {code}: {said}"
    code, said, followed = table.search(name + "_followed", with_structure(goal, **yaml.safe_load(words)), process)
    if code == 124:
        return None
    if code != 0:
        return f"search {code}: " + (errors_of(followed) if code == 3 else said)
    code, said = table.run("export", followed, "--format", "stl", "-o", out)
    return "" if code == 0 else f"export {code}: {said}"


def advice_row(table, name, goal, process):
    code, said, results = table.search(name, goal, process)
    if code == 1 or (code == 2 and "wall_mm" not in said and "cell_mm" not in said and "cells" not in said):
        table.add(name, "search", f"search {code}: {said}")
    if code != 3:
        return
    refused, refusal = table.run("export", results, "--format", "stl", "-o", results + "_print")
    for advice in advice_of(errors_of(results), refusal if refused else ""):
        why = follow(table, name, goal, process, results, advice)
        if why is not None:
            table.add(name, advice[1], why)


def positions(state):
    return numpy.array([pose["position_mm"] for pose in state["poses"]])


def distance(points, wanted):
    """Returns the rms distance after a rigid motion, over the diagonal of the wanted points' box."""
    a, b = points - points.mean(0), wanted - wanted.mean(0)
    u, _, v = numpy.linalg.svd(a.T @ b)
    turn = u @ numpy.diag([1, 1, numpy.sign(numpy.linalg.det(u @ v))]) @ v
    return numpy.sqrt(((a @ turn - b) ** 2).sum(1).mean()) / numpy.linalg.norm(numpy.ptp(b, axis=0))


def target_state(results):
    with open(os.path.join(results, "result.json")) as file:
        return next(state for state in json.load(file)["states"] if state["name"] == "target")


def simulate(table, name, goal, results):
    """Returns (what was measured, why it does not work)."""
    with open(os.path.join(results, "result.json")) as file:
        manufacture = json.load(file).get("manufacture")
    if not manufacture or not manufacture["drive"]:
        return NO_DRIVE, ""
    with open(os.path.join(results, "design.yaml")) as file:
        design = yaml.safe_load(file)
    design["drive"] = design.get("drive") or manufacture["drive"]
    file = os.path.join(table.given.folder, name + "_driven.yaml")
    with open(file, "w") as out:
        yaml.safe_dump(design, out, sort_keys=False)
    folded = results + "_simulated"
    code, said = table.run("simulate", file, "--model", "equilibrium", "-o", folded)
    if code == 124:
        table.not_run += 1
        return NO_DRIVE, ""
    if code != 0:
        return design["drive"]["kind"], f"simulate {code}: " + (errors_of(folded) if code == 3 else said)
    error = distance(positions(target_state(folded)), positions(target_state(results)))
    allowed = (goal.get("tolerance") or {}).get("shape", usual_tolerance)
    what = f"{design['drive']['kind']}, {manufacture['hinge']['kind']}s: {error:.2g} of the diagonal"
    return what, "" if error <= allowed else f"{allowed:g} are allowed"


def drive_row(table, name, goal, process):
    code, _, results = table.search(name, goal, process)
    if code == 0:
        what, why = simulate(table, name, goal, results)
        if what == NO_DRIVE:
            print(f"{name:36} names no drive, or its simulation is not through in time", flush=True)
        else:
            table.add(name, what, why)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program")
    options.add_argument("folder")
    options.add_argument("--drives", action="store_true")
    options.add_argument("--only", default="")
    options.add_argument("--process", nargs="+", default=PROCESSES)
    options.add_argument("--seconds", type=float, default=60, help="of one run of the program")
    given = options.parse_args()
    table = Table(given)
    for target, text, processes in targets(given.only, given.process):
        for process in processes:
            if given.drives:
                drive_row(table, f"{target}_{process}", yaml.safe_load(without_cell_mm(text)), process)
                continue
            for variant, goal in variants(yaml.safe_load(text)):
                advice_row(table, f"{target}_{variant}_{process}", goal, process)
    return table.end("drives fold their designs" if given.drives else "advices work")


if __name__ == "__main__":
    sys.exit(main())
