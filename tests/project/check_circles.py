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
# Fewer arrows between folders than that, and the pattern of includes is wrong.
LEAST_ARROWS = 30
# Circles that still stand: "from -> to". Strike an arrow as soon as it is on no circle.
KNOWN = ()


def arrows_of(root):
    """Which folders of its own room each folder includes, and by which files."""
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
    """Every arrow from whose end its start is reached again, with the files that make it."""
    reached = {folder: reached_from(folder, arrows) for folder in arrows}
    return {f"{folder} -> {other}": files for folder in arrows for other, files in arrows[folder].items()
            if folder in reached.get(other, ())}


def complaints_about(root):
    arrows = arrows_of(root)
    if sum(map(len, arrows.values())) < LEAST_ARROWS:
        yield "hardly any includes between folders found: is the path or the pattern right?"
    circles = on_circles(arrows)
    for arrow, files in sorted(circles.items()):
        if arrow not in KNOWN:
            yield f"{arrow} is on a circle: {'; '.join(files)}"
    for arrow in sorted(set(KNOWN) - circles.keys()):
        yield f"{arrow} is on no circle any more: strike it from the list in check_circles.py"


def sees_a_circle():
    """Proof that circles are found, also long ones, and what hangs on them is not."""
    around = {"a": {"b": []}, "b": {"c": []}, "c": {"a": [], "d": []}, "d": {}}
    return set(on_circles(around)) == {"a -> b", "b -> c", "c -> a"}


def main():
    complaints = list(complaints_about(sys.argv[1]))
    if not sees_a_circle():
        complaints.append("this check does not see a circle of three")
    print("\n".join(complaints) or "no new circles")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
