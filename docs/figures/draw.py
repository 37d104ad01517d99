#!/usr/bin/python3
"""Draws every figure of docs/ from the closed forms of kinematics.md: the same bytes on every run.

usage: draw.py [FOLDER]     writes FOLDER/*.svg, by default next to this script
"""
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # no folder of compiled modules beside the figures

import cell
import crease_law
import first_design
import hinge
import lattices
import nets
import planar
import sheets

FIGURES = {
    "cell.svg": cell.write,
    "planar.svg": planar.write,
    "bending.svg": sheets.bending,
    "tilted_rows.svg": sheets.tilted_rows,
    "nets.svg": nets.write,
    "crease_law.svg": crease_law.write,
    "hinge.svg": hinge.write,
    "lattices.svg": lattices.write,
    "wave.svg": first_design.write,
}


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
    for name, figure in FIGURES.items():
        (folder / name).write_text(figure(), encoding="utf-8")


if __name__ == "__main__":
    main()
