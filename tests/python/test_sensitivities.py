import unittest

import numpy as np
from support import Scratch, strip

import kinetix

SEED = 5
print("seed", SEED)
# Tilts that leave every exact family, so that hinges stretch.
TILTS = np.random.default_rng(SEED).uniform(-0.15, 0.15, 24)


PLATES = {"kind": "plates", "axis": "y", "compression": 0.08}
# Plates leave flat by a bifurcation, to a side that small changes may turn; a hinge that is turned knows its side.
TURN = {"kind": "hinge", "wall": [[1, 1], [2, 1]], "angle_deg": 30}


def panel(change=None, hinge=0, k_turn=0.2, drive=TURN):
    """3 x 3 cells; one number of one hinge changed."""
    design = {"kinetix": 1, "structure": {"cells": [3, 3], "cell_mm": 10},
              "drive": drive,
              "hinge": {"model": "elastic", "k": {"axial": 20, "shear": 8, "along": 10, "turn": k_turn}, "reach_mm": 1.7}}
    sheet = kinetix.Design(design)
    numbers = {name: getattr(sheet, name).copy() for name in ("t", "alpha", "beta", "offset_mm")}
    numbers["beta"] += TILTS
    for name, step in (change or {}).items():
        numbers[name][hinge] += step
    return sheet.with_hinges(**numbers)


def pressed(*arguments, **options):
    result = kinetix.simulate(panel(*arguments, **options), "equilibrium")
    assert result.reached, result.summary()
    return result


def span(result):
    """Returns the distance of two far bodies, mm."""
    line = result.state("equilibrium").positions
    return np.linalg.norm(line[13] - line[1])


def span_rates(result):
    line = result.state("equilibrium").positions
    along = (line[13] - line[1]) / np.linalg.norm(line[13] - line[1])
    rates = np.zeros((16, 6))
    rates[13, :3], rates[1, :3] = along, -along
    return rates


class Sensitivities(Scratch):
    def test_by_hinges_they_are_those_of_central_differences(self):
        result = pressed()
        by = {"span": result.sensitivity(span_rates(result)), "energy": result.sensitivity(energy=1),
              "load": result.sensitivity(load=1)}
        for name, step in (("t", 1e-4), ("alpha", 1e-4), ("beta", 1e-4), ("offset_mm", 1e-3)):
            for hinge in (0, 7, 16):
                two = [pressed({name: sign * step}, hinge) for sign in (1, -1)]
                measured = {"span": [span(r) for r in two], "energy": [r.path["energy"][-1] for r in two],
                            "load": [r.path["load"][-1] for r in two]}
                for what, (after, before) in measured.items():
                    largest = np.abs(by[what][name]).max()
                    self.assertAlmostEqual(by[what][name][hinge], (after - before) / (2 * step), delta=2e-3 * largest,
                                           msg=f"{what} by {name} of hinge {hinge}")

    def test_by_stiffness_too(self):
        result = pressed()
        after, before = (pressed(k_turn=k).path["load"][-1] for k in (0.201, 0.199))
        rate = result.sensitivity(load=1)["k_turn"]
        self.assertAlmostEqual(rate, (after - before) / 0.002, delta=1e-3 * abs(rate))

    def test_the_work_of_the_drive_is_the_energy(self):
        """dE/dtheta = load d(drive)/dtheta, with plates 30 mm apart: 30 sin(theta) mm a rad."""
        result = pressed(drive=PLATES)
        theta, load = result.path["theta"][-1], result.path["load"][-1]
        self.assertAlmostEqual(result.sensitivity(energy=1)["theta"], load * 30 * np.sin(theta), places=6)

    def test_without_an_equilibrium_there_are_none(self):
        with self.assertRaisesRegex(kinetix.InvalidInput, "there is no equilibrium"):
            kinetix.simulate(strip(4)).sensitivity(energy=1)
        with self.assertRaisesRegex(kinetix.InvalidInput, r"poses must have the shape \(16, 6\)"):
            pressed().sensitivity(np.zeros((16, 7)))


if __name__ == "__main__":
    unittest.main()
