#!/usr/bin/python3
"""paper.py PROGRAM: runs the sweeps of the paper's equations 3, 4 and 6, and prints each equation against kinetix."""
import csv
import math
import subprocess
import sys
import tempfile
from pathlib import Path

SWEEPS = Path(__file__).resolve().parents[2] / "targets/sweeps"


def area(k):
    return (2 + math.sqrt(2)) * k ** 2 - (2 + math.sqrt(2)) * k + 1


def shear_deg(k):
    return math.degrees(math.atan((1 - k) / k))


def twist_deg(alpha_deg):
    return math.degrees(2 * math.atan(1 / (math.sin(math.radians(45)) / math.tan(math.radians(alpha_deg)))))


# Sweep, its factor and response, the paper's value at the same place, and the value that it stands for.
EQUATIONS = [
    ("Eq. 3, area ratio", "eq3_area", "k", "area_ratio", area, lambda value: value),
    ("Eq. 4, shear angle, deg", "eq4_shear", "k", "cell_angle_deg", shear_deg, lambda value: value / 2),
    ("Eq. 6, twist angle, deg", "eq6_twist", "alpha_deg", "lean_max_deg", twist_deg, lambda value: 180 - value),
]


def main():
    print(f"{'equation':25} {'at':>6} {'paper':>10} {'kinetix':>10} {'largest difference':>20}")
    for title, sweep, factor, response, law, converted in EQUATIONS:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.argv[1], "sweep", SWEEPS / f"{sweep}.yaml", "-o", f"{folder}/out", "--quiet"], check=True,
                           stdout=subprocess.DEVNULL)
            lines = Path(folder, "out/samples.csv").read_text(encoding="utf-8").splitlines()
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        pairs = [(float(row[factor]), converted(float(row[response]))) for row in rows if abs(float(row[factor]) - 0.5) > 1e-9]
        largest = max(abs(value - law(at)) for at, value in pairs)
        for at, value in (pairs[len(pairs) // 4], pairs[3 * len(pairs) // 4]):
            print(f"{title:25} {at:6.2f} {law(at):10.4f} {value:10.4f} {largest:20.1g}")


main()
