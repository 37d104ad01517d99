#!/usr/bin/python3
"""No circle of includes between the folders of a room: whoever reads a folder needs only those it includes.

usage: check_circles.py SOURCE_FOLDER
"""
import os
import re
import sys
from collections import defaultdict
from pathlib import Path

ROOMS = ("model", "targets", "optim", "sim", "app", "python", "tests", "benchmarks")
# A smaller number of arrows between folders means that the pattern of includes is wrong.
LEAST_ARROWS = 30
# The floors of the program, lowest first. A folder includes its floor and lower floors.
FLOORS = {"app": "io cad models files pictures viewer report run console pipeline result exports goals print studio "
                 "sweep imports cli formats".split()}
# Circles that remain, as "from -> to". Remove an arrow as soon as it is on no circle.
KNOWN = ()


def arrows_of(root):
    """Finds the folders of the same room that each folder includes, and the files that include them."""
    arrows = defaultdict(lambda: defaultdict(list))
    for room in ROOMS:
        for path in sorted(Path(root, room).rglob("*.[ch]pp")):
            folder = path.parent.relative_to(root).as_posix()
            for include in re.findall(r'^#include "([^"]+)"', path.read_text(encoding="utf-8"), re.M):
                other = os.path.dirname(include)
                if other != folder and other.split("/")[0] == room and Path(root, include).exists():
                    arrows[folder][other].append(f"{path.name} includes {os.path.basename(include)}")
    return arrows


def reached_from(folder, arrows):
    reached, ahead = set(), [folder]
    while ahead:
        for other in arrows.get(ahead.pop(), ()):
            if other not in reached:
                reached.add(other)
                ahead.append(other)
    return reached


def on_circles(arrows):
    """Returns every arrow on a circle, with the files that make it."""
    reached = {folder: reached_from(folder, arrows) for folder in arrows}
    return {f"{folder} -> {other}": files for folder in arrows for other, files in arrows[folder].items()
            if folder in reached.get(other, ())}


def upwards(arrows, room, floors):
    """Returns every arrow between top folders of a room that leads up, and the folders without a floor."""
    for folder in sorted(arrows):
        for other in sorted(arrows[folder]):
            ends = [path.split("/")[1] for path in (folder, other) if path.split("/")[0] == room and "/" in path]
            unknown = [end for end in ends if end not in floors]
            if unknown:
                yield f"{room}/{unknown[0]} has no floor in check_circles.py"
            elif len(ends) == 2 and floors.index(ends[0]) < floors.index(ends[1]):
                yield f"{folder} -> {other} leads up: {'; '.join(arrows[folder][other])}"


def complaints_about(root):
    arrows = arrows_of(root)
    for room, floors in FLOORS.items():
        yield from upwards(arrows, room, floors)
    if sum(map(len, arrows.values())) < LEAST_ARROWS:
        yield "hardly any includes between folders found: is the path or the pattern right?"
    circles = on_circles(arrows)
    for arrow, files in sorted(circles.items()):
        if arrow not in KNOWN:
            yield f"{arrow} is on a circle: {'; '.join(files)}"
    for arrow in sorted(set(KNOWN) - circles.keys()):
        yield f"{arrow} is on no circle any more: strike it from the list in check_circles.py"


def finds_circle():
    """Proves that the check finds circles, also long ones, and ignores folders that only lead to one."""
    around = {"a": {"b": []}, "b": {"c": []}, "c": {"a": [], "d": []}, "d": {}}
    return set(on_circles(around)) == {"a -> b", "b -> c", "c -> a"}


def finds_upward_path():
    """Proves that the check finds an arrow to a higher floor and ignores one to a lower floor."""
    arrows = {"app/low": {"app/high/deep": ["x"]}, "app/high": {"app/low": []}}
    return list(upwards(arrows, "app", ["low", "high"])) == ["app/low -> app/high/deep leads up: x"]


def main():
    complaints = list(complaints_about(sys.argv[1]))
    if not finds_circle():
        complaints.append("this check does not see a circle of three")
    if not finds_upward_path():
        complaints.append("this check does not see an include that leads up")
    print("\n".join(complaints) or "no new circles")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
