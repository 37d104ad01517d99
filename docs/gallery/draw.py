#!/usr/bin/python3
"""draw.py PROGRAM WORK [NAME...]: runs every design of the gallery, exports it and draws it.

Writes docs/gallery/NAME.png, docs/figures/hero.png and docs/gallery.md. All sizes, forces and times are from these runs.
Folders of WORK that exist are used again: delete WORK for new runs.
"""
import json
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True  # no folder of compiled modules next to the pictures

import numpy as np

from backdrop import backdrop_of
from designs import DESIGNS, HERO
from page import write_page
from picture import Mesh, EVEN, ODD, SOFT, coin, draw, read_stl, shells, write_png
from posture import posed
from walls import places_and_normals_of, wall_meshes

SOURCE = Path(__file__).resolve().parents[2]
WIDTH, TALLEST = 900, 520  # px
HERO_SIZE = 1400, 620  # px
GAP = 0.08  # between two things, over the width of the wider one
LIMIT_S = 1200  # of one run


def run(*command):
    started = time.monotonic()
    done = subprocess.run([str(word) for word in command], cwd=SOURCE, capture_output=True, text=True, timeout=LIMIT_S)
    return done.returncode, time.monotonic() - started, done.stderr


def solids(folder, bodies, is_plain):
    """Returns the exported solids in one mesh. Bodies with vertices of an even sum have another colour than the others, unless the faces
    behind them have a colour (`is_plain`)."""
    corners = read_stl(folder / "hard.stl")
    odd = [sum(body.get("vertex", [k])) % 2 for k, body in enumerate(bodies)]
    numbers = shells(corners)
    colours = [EVEN if is_plain else (EVEN, ODD)[odd[n] if n < len(odd) else n % 2] for n in numbers]
    mesh = Mesh(corners, colours)
    return mesh + Mesh(read_stl(folder / "soft.stl"), SOFT) if (folder / "soft.stl").exists() else mesh


def places_and_normals_in(folder, result, backdrop):
    """Returns the middles of bodies, the normals of the sheet there and the backdrop, as the files of the folded state have them. An export
    may turn the sheet: middles of the solids show by how much (Kabsch's method). None where solids are not the bodies."""
    places, normals = places_and_normals_of(result)
    corners = read_stl(folder / "hard.stl")
    numbers = shells(corners)
    if numbers.max() + 1 != len(places):
        return None, None, None
    middles = np.array([corners[numbers == k].mean(axis=(0, 1)) for k in range(len(places))])
    u, _, v = np.linalg.svd((places - places.mean(axis=0)).T @ (middles - middles.mean(axis=0)))
    rotation = (u @ np.diag([1, 1, np.sign(np.linalg.det(u @ v))]) @ v).T
    if backdrop:
        backdrop = backdrop.moved(-places.mean(axis=0)).turned(rotation).moved(middles.mean(axis=0))
    return middles, normals @ rotation.T, backdrop


class Run:
    """A design of the gallery, searched and exported."""

    def __init__(self, program, work, design):
        self.design, self.folder = design, work / design.name
        record = self.folder / "gallery.json"
        if not record.exists():
            code, seconds, errors = run(program, f"targets/shapes/{design.name}.yaml", "-o", self.folder, "--quiet")
            if code not in (0, 3):
                sys.exit(f"{design.name}: exit code {code}\n{errors}")
            exported = [run(program, "export", self.folder, "--format", "stl", "--state", state, "--quiet",
                            "-o", self.folder / state, *design.options) for state in ("flat", "folded")]
            record.write_text(json.dumps({"code": code, "seconds": seconds, "export": max(e[0] for e in exported),
                                          "refusal": exported[0][2].strip()}))
        self.record = json.loads(record.read_text())
        self.result = json.loads((self.folder / "result.json").read_text())
        self.is_exported = self.record["export"] == 0
        if self.is_exported:
            is_plain = len(self.result.get("fold", {}).get("ideal_mm", [])) > 6
            flat, folded = (solids(self.folder / state, self.result["structure"]["bodies"], is_plain) for state in ("flat", "folded"))
            places, normals, backdrop = places_and_normals_in(self.folder / "folded", self.result, backdrop_of(design.name, self.result))
            self.print = json.loads((self.folder / "flat/print.json").read_text())
        else:
            flat, folded = wall_meshes(self.result)
            places, normals = places_and_normals_of(self.result)
            backdrop, self.print = backdrop_of(design.name, self.result), None
        self.flat, self.folded = flat.on_table(), posed(folded, design.posture, places, normals).on_table()
        self.shown = posed(folded + backdrop, design.posture, places, normals).on_table() if backdrop else self.folded

    def scene(self):
        """Returns both states on one table, next to each other or one behind the other, with a coin."""
        flat, folded = self.flat, self.shown
        wide, deep, _ = flat.size()
        if self.design.is_behind or wide > 3 * deep:
            gap = GAP * wide
            folded = folded.moved([0, deep / 2 + gap + folded.size()[1] / 2, 0])
        else:
            folded = folded.moved([wide / 2 + GAP * wide + folded.size()[0] / 2, 0, 0])
        both = flat + folded
        low, high = both.bounds()
        return both + coin().moved([flat.bounds()[0][0] + 12, low[1] - 18, 0])


def draw_hero(runs):
    """Draws a few designs in a row, to one scale."""
    row, left = None, 0.0
    for run_ in runs:
        flat, folded = run_.flat, run_.shown
        behind = flat.size()[1] / 2 + 15 + folded.size()[1] / 2
        pair = flat.moved([0, -behind, 0]) + folded
        low, high = pair.bounds()
        pair = pair.moved([left - low[0], -low[1], 0])
        left += high[0] - low[0] + 30
        row = pair if row is None else row + pair
    low, high = row.bounds()
    scene = row + coin().moved([low[0] + 40, low[1] - 22, 0])
    write_png(SOURCE / "docs/figures/hero.png", draw(scene, 6, 32, *HERO_SIZE))


def main():
    program, work = (Path(word).resolve() for word in sys.argv[1:3])
    names, started = sys.argv[3:], time.monotonic()
    runs = []
    for design in DESIGNS:
        if names and design.name not in names:
            continue
        here = Run(program, work, design)
        write_png(SOURCE / f"docs/gallery/{design.name}.png", draw(here.scene(), design.azimuth_deg, design.elevation_deg, WIDTH, TALLEST))
        for name in ("afar_before", "afar_after", "afar_after_enhanced") if design.is_display else ():
            shutil.copy(here.folder / f"{name}.png", SOURCE / f"docs/gallery/{design.name}_{name}.png")
        print(f"{design.name}: {here.record['seconds']:.1f} s, exit code {here.record['code']}, export {here.record['export']}")
        runs.append(here)
    if not names:
        draw_hero([run_ for name in HERO for run_ in runs if run_.design.name == name])
        write_page(SOURCE / "docs/gallery.md", runs)
        print(f"all in {time.monotonic() - started:.0f} s")


if __name__ == "__main__":
    main()
