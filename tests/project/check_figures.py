#!/usr/bin/env python3
"""check_figures.py ROOT: checks that figures in the documentation match the table in benchmarks/README.md, to the
digits given."""
import pathlib
import re
import sys

NUMBER = r"(-?[0-9][0-9 ]*(?:\.[0-9]+)?(?:e[-+]?[0-9]+)?)"

# Entries: page; passage with # for each figure; first words of the table's row; its measured text with # for the same
# figures. The last entry is the unit of the row divided by that of the page.
FIGURES = [
    ("README.md", "Folding a 40-column strip takes # µs", "one state of a 40-column strip", "# us", 1),
    ("README.md", "A letter T on 10 × 10 cells takes # s in all", "letter_t.yaml, whole run", "# s", 1),
    ("README.md", "the search for a 40-column curve takes about # ms", "helmet_rib, 40 columns, all 8 starts", "# ms", 1),
    ("docs/tutorials/helmet.md", "The design takes # s", "headform, 8 ribs, 6 mm cells: design time", "# s", 1),
    ("docs/tutorials/helmet.md", "and # s with all checks", "headform.yaml, whole run", "# s", 1),
    ("docs/tutorials/helmet.md", "fit this headform to # mm", "headform, 8 ribs, 6 mm cells: distance from head", "max # mm", 1),
    ("docs/tutorials/display.md", "grow to # times the area of the others", "T, B, E, S, R, Q, 12 x 12 cells, rows free", "ratio #", 1),
    ("docs/tutorials/display.md", "with straight rows to # times", "T, B, E, S, R, Q, 12 x 12 cells, rows straight, offset <= 0.8 mm: exact state", "ratio #", 1),
    ("docs/how-to/sweeps.md", "Threads compute # designs", "sweep of the exact model, 40-column strip", "# a second", 1),
    ("docs/how-to/shapes.md", "cells is found in # s", "outline search, disc from 12 x 12 squares", "walls never meet, # s", 1),
    ("docs/how-to/shapes.md", "or in # s if both outlines", "square to disc, both outlines prescribed", "walls never meet, # s", 1),
    ("docs/how-to/elastic-hinges.md", "built of rubber | # mm", "helmet rib of rubber hinges and springs", "# mm,", 1),
    ("docs/how-to/elastic-hinges.md", "| compensated | # mm", "helmet rib of rubber hinges and springs", "mm, # mm", 1),
    ("docs/how-to/elastic-hinges.md", "`robust: true` | # mm", "the same, robust: as made", "design # mm off", 1),
    ("docs/how-to/elastic-hinges.md", "They are # mm off instead of # mm", "the same, robust: as made", "# mm, # mm", 1),
    ("docs/explanation/limits.md", "a letter on 32 × 32 cells takes # s", "letter T in 32 x 32 cells, flat to 16 %", "# s,", 1),
    ("docs/explanation/limits.md", "100 × 100 cells # s", "letter T in 100 x 100 cells, flat to 16 %", "# s,", 1),
    ("docs/project/reproduce.md", "both states are found to # rad", "twist unit, alpha 30 to 85 deg", "both, # rad", 1),
    ("docs/project/reproduce.md", "agree with the exact motion to # cell edges", "helmet_rib, 80 columns: Bullet", "rms #,", 1),
    ("docs/project/reproduce.md", "falls with the gap: #, #, #, #, # N mm", "the same at alpha 75 deg with the plays", "#, #, #, #, # N mm", 1),
    ("docs/project/reproduce.md", "follows from geometry to # %", "the paper's twist unit, 30 mm", "# %;", 1),
    ("docs/project/reproduce.md", "simulation agree to # cell edges at", "gradient panel, 8 x 8, theta 20 deg", "agrees, rms # cell edges", 1),
    ("docs/project/reproduce.md", "at *k* = 0.15, has an AUC of #", "letter T, 10 x 10 cells, 12 % compression: the paper's rule alone", "auc #,", 1),
    ("docs/project/reproduce.md", "on their walls as in the paper: AUC # in the simulation", "circle, 12 x 12 cells, in the physics run", "auc #,", 1),
    ("docs/project/reproduce.md", "mm from the head at most, in # s", "headform, 8 ribs, 6 mm cells: design time", "# s", 1),
    ("docs/reference/hinges.md", "| largest difference | # %", "block hinges, L/t 1 to 4, h/t 5 to 10, nu 0.3 and 0.48, against CalculiX: axial", "# % at most", 1),
    ("docs/reference/hinges.md", "| largest difference | 1.0 % | # %", "block hinges, L/t 1 to 4, h/t 5 to 10, nu 0.3 and 0.48, against CalculiX: turn", "# % at most", 1),
    ("docs/reference/hinges.md", "| 1.2 % | # %", "block hinges, L/t 1 to 4, h/t 5 to 10, nu 0.3 and 0.48, against CalculiX: along", "# % at most", 1),
    ("docs/reference/hinges.md", "| 3.3 % | # %", "block hinges, L/t 1 to 4, h/t 5 to 10, nu 0.3 and 0.48, against CalculiX: shear", "# % at most", 1),
    ("docs/reference/hinges.md", "| 7.3 % | # %", "block hinges, L/t 1 to 4, h/t 5 to 10, nu 0.3 and 0.48, against CalculiX: rocking", "# % at most", 1),
    ("docs/reference/hinges.md", "| 3.1 % | # %", "block hinges, L/t 1 to 4, h/t 5 to 10, nu 0.3 and 0.48, against CalculiX: twist", "# % at most", 1),
    ("docs/reference/hinges.md", "| helmet rib, 40 columns | # mm | # mm | # mm", "helmet rib of rubber hinges and springs", "# mm, # mm (52 times), # mm", 1),
    ("docs/reference/hinges.md", "rubber hinges, rms, 95 % | #, # mm | #, # mm", "as made, helmet rib of 40 columns, rubber hinges",
     "rms # mm to first order, # mm in 1000 prints (0.6 %); 95 of 100 within # and # mm", 1, (0, 2, 1, 3)),
    ("docs/reference/hinges.md", "letter T, rubber hinges, separation d′, 95 %, AUC | #, #, 1.000 | #, #, 1.000", "the same of a letter T, 10 x 10 cells: contrast",
     "# to first order, # in 1000 prints; above # and #", 1, (0, 2, 1, 3)),
    ("docs/explanation/kinematics.md", "A cap of 60 degrees (from corner to corner) is met to # %", "cap of 60 deg, 8 x 8 facets, edges 0.3", "#, largest", 100),
    ("docs/explanation/kinematics.md", "of their mean meet it to # %", "cap of 60 deg, 8 x 8 facets, edges 0.6", "#, largest", 100),
    ("docs/explanation/kinematics.md", "is met to # %, and a vase", "saddle 0.3, 8 x 8 facets", "#, largest", 100),
    ("docs/explanation/kinematics.md", "eight ribs is within # %", "the same cap by 8 ribs and by a fishbone", "fishbone: #,", 100),
    ("docs/explanation/kinematics.md", "in between: # % of the cap", "the same cap by 8 ribs and by a fishbone", "# % of the area open; ribs", 1),
    ("docs/explanation/kinematics.md", "80 mm high, is met to # %", "helix of two turns, 96 columns", "rms #,", 100),
    ("docs/explanation/kinematics.md", "meets itself at #° is free in every sample a degree apart up to #°", "range free of contact, proven: turns of a helix",
     "# deg, samples say # deg", 1),
    ("docs/reference/hinges.md", "is # mm off to first order and # mm with 1000 prints", "as made, hinges left open and taken for soft blocks",
     "rms # mm to first order, # mm in 1000 prints", 1),
    ("docs/reference/hinges.md", "per side | 0.304 | # |", "twist unit of 70 deg, pins with a play of 0.22 mm", "flips freely from a play of # mm", 1),
    ("docs/reference/hinges.md", "are # mm off at 7° and # mm at 30°", "the same, robust: as made", "# mm, # mm", 1),
    ("docs/explanation/kinematics.md", "12 × 12 facets to # %", "vase, 12 x 12 facets", "#,", 100),
    ("docs/explanation/kinematics.md", "grow to about # times the others' area", "T, B, E, S, R, Q, 12 x 12 cells, rows free", "ratio #", 1),
    ("docs/project/scaling.md", "a strip | # us | 10^6: # ms, # GiB | # | #", "exact model, strips: growth",
     "time to the #, memory to the # of the cells; 100 cells: # ms; 1e+06 cells: # s, # GiB", (1000, 1000, 1, 1, 1), (2, 3, 4, 0, 1)),
    ("docs/project/scaling.md", "a sheet | # us | 10^6: # ms, # GiB | # | #", "exact model, sheets: growth",
     "time to the #, memory to the # of the cells; 100 cells: # ms; 1e+06 cells: # s, # GiB", (1000, 1000, 1, 1, 1), (2, 3, 4, 0, 1)),
    ("docs/project/scaling.md", "hexagons | # ms | 10^5: # s, # GiB | # | #", "planar, null space of hexagons",
     "time to the #, memory to the # of the cells; 100 cells: # ms; 1e+05 cells: # s, # GiB", 1, (2, 3, 4, 0, 1)),
    ("docs/project/scaling.md", "8 starts | - | 400: # s, # MB | # | #", "search for a half circle, 8 starts",
     "time to the #, memory to the # of the cells; 10 cells: 4.59 ms; 400 cells: # s, # GiB", (1, 1000, 1, 1), (2, 3, 0, 1)),
    ("docs/project/scaling.md", "a strip, flat to 0.5 rad | - | 320: # s | # | #", "equilibrium, strips that bend",
     "time to the #, memory to the # of the cells; 20 cells: 7.96 ms; 320 cells: # s", 1, (2, 0, 1)),
    ("docs/project/scaling.md", "a sheet, flat to 0.5 rad | # ms | 10^4: # s, # GiB | # | #", "equilibrium, sheets that bend",
     "time to the #, memory to the # of the cells; 100 cells: # ms; 1e+04 cells: # s, # GiB", 1, (2, 3, 4, 0, 1)),
    ("docs/project/scaling.md", "simulation, a strip, one step | # ms | 10^4: # s, # GiB | # | #", "physics run, strips, a step",
     "time to the #, memory to the # of the cells; 100 cells: # ms; 1e+04 cells: # s, # GiB", 1, (2, 3, 4, 0, 1)),
    ("docs/project/scaling.md", "simulation, a sheet, one step | # ms | 10^4: # s, # GiB | # | #", "physics run, sheets, a step",
     "time to the #, memory to the # of the cells; 100 cells: # ms; 1e+04 cells: # s, # GiB", 1, (2, 3, 4, 0, 1)),
]


def found(passage, text):
    match = re.search(re.escape(passage).replace(r"\#", "#").replace("#", NUMBER).replace(r"\ ", r"\s+"), text)
    return match and [number.replace(" ", "") for number in match.groups()]


def same(written, measured):
    """Checks whether the measured number, rounded like the written number, equals it."""
    digits = re.sub(r"e.*", "", written)
    if "." in digits:
        return abs(float(written) - measured) <= 0.5000001 * 10 ** -len(digits.split(".")[1])
    zeros = len(digits) - len(digits.rstrip("0"))
    return abs(float(written) - measured) <= 0.5000001 * 10 ** zeros


root = pathlib.Path(sys.argv[1])
rows = [line.split(" | ") for line in (root / "benchmarks/README.md").read_text().splitlines() if line.startswith("| ")]
wrong = []
for page, passage, row, measured_text, unit, *order in FIGURES:
    written = found(passage, (root / page).read_text())
    measured = [r for r in rows if r[0][2:].startswith(row)]
    numbers = measured and found(measured_text, measured[0][2])
    if not written or not numbers:
        wrong.append(f"{page}: {'no passage' if not written else 'no row'} for: {passage!r}, row {row!r}")
        continue
    if order:
        numbers = [numbers[k] for k in order[0]]
    units = unit if isinstance(unit, tuple) else (unit,) * len(numbers)
    for said, number, factor in zip(written, numbers, units):
        if not same(said, float(number) * factor):
            wrong.append(f"{page}: says {said} in {passage!r}; benchmarks/README.md has {number} (row {row!r})")
met = sum(1 for r in rows if r[-1].strip() in ("yes |", "**no** |"))
yes = sum(1 for r in rows if r[-1].strip() == "yes |")
for page, passage, totals in (("README.md", "meet # of # targets", [yes, met]), ("docs/index.md", "# of # targets are met", [yes, met]),
                              ("docs/explanation/limits.md", "# of # benchmark targets are missed", [met - yes, met])):
    said = found(passage, (root / page).read_text())
    if not said or [int(n) for n in said] != totals:
        wrong.append(f"{page}: says {said} in {passage!r}, the table has {totals}")
print("\n".join(wrong) or f"{len(FIGURES)} passages have the figures of the benchmarks")
sys.exit(1 if wrong else 0)
