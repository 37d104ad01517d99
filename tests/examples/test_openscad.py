"""Tests the modules for OpenSCAD in OpenSCAD: every part has the volume and the position of the result, flat and
folded."""
import json
import re
import shutil
import sys
import unittest

from support import PROGRAM, SOURCE, Scratch, command_output

sys.path.insert(0, str(SOURCE / "examples"))
import kinetix_reader as reader  # noqa: E402

# Seven columns that bend, folded by 25 degrees.
ARCH = "kinetix: 1\nstructure: {cells: [7, 1], cell_mm: 16}\ndesign:\n  theta_deg: 25\n  hinges:\n" + "".join(
    f"    - {{wall: [[{c}, {j}], [{c + 1}, {j}]], beta_deg: {12 if (c + j) % 2 else -12}}}\n" for c in range(7) for j in (0, 1))
ROUNDING = 2e-4  # mm: OpenSCAD writes six digits, of up to 120 mm


def triangles_of(file):
    """Reads the triangles of an STL file in text format."""
    corners = [[float(number) for number in line.split()[1:]] for line in file.read_text().splitlines()
               if line.strip().startswith("vertex")]
    return [corners[k:k + 3] for k in range(0, len(corners), 3)]


def volume(triangles):
    return sum(reader.dot(a, reader.cross(b, c)) / 6 for a, b, c in triangles)


def middle(triangles):
    """Computes the centroid of the solid's volume."""
    parts = [(reader.dot(a, reader.cross(b, c)) / 6, reader.times(0.25, reader.add(a, reader.add(b, c))))
             for a, b, c in triangles]
    total = sum(share for share, _ in parts)
    return [sum(share * p[i] for share, p in parts) / total for i in range(3)]


@unittest.skipUnless(shutil.which("openscad"), "no OpenSCAD here")
class OpenScad(Scratch):
    def export(self, hinge):
        design = self.folder / "arch.yaml"
        design.write_text(ARCH)
        command_output(PROGRAM, "simulate", design, "-o", self.folder / "found", "--quiet")
        command_output(PROGRAM, "export", design, "--format", "scad", "--hinge", hinge, "-o", self.folder / "print")
        self.print = json.loads((self.folder / "print/print.json").read_text())
        self.result = reader.Result(self.folder / "found/result.json")
        (self.scad,) = (self.folder / "print").glob("*.scad")

    def part(self, call):
        """Returns the triangles that a call of the modules makes."""
        scene, out = self.folder / "print/scene.scad", self.folder / "print/scene.stl"
        scene.write_text(f"use <{self.scad.name}>\n{call}\n")
        said = command_output("openscad", "-o", out, scene)
        self.assertNotIn("WARNING", said)
        return triangles_of(out)

    def expect_carried(self, flat, folded, body, pose):
        """Checks that the centroid of a part moves with its body."""
        arm = reader.add(middle(flat), reader.times(-1, body.rest))
        for a, b in zip(pose.carry(arm), middle(folded)):
            self.assertAlmostEqual(a, b, delta=ROUNDING)

    def test_bodies_have_their_volume_and_go_where_the_result_says(self):
        self.export("pin")
        total = 0
        # The motion in the file is relative to body 0. The displayed results begin with body 0, too.
        shown = self.result.steps[-1]
        for number, body in enumerate(self.result.bodies):
            flat = self.part(f"body({number}, 0);")
            total += volume(flat)
            if number % 3 == 0:
                folded = self.part(f"body({number}, 1);")
                self.assertAlmostEqual(volume(folded), volume(flat), delta=1e-3 * volume(flat))
                self.expect_carried(flat, folded, body, shown[number])
        self.assertAlmostEqual(total, self.print["volume_mm3"]["hard"], delta=1e-3 * total)

    def test_soft_parts_have_their_volume_and_stretch_with_their_walls(self):
        self.export("block")
        volumes = [volume(self.part(f"soft({hinge}, 0);")) for hinge in range(0, len(self.result.hinges), 4)]
        for got in volumes:
            self.assertAlmostEqual(got, self.print["volume_mm3"]["soft"] / len(self.result.hinges), delta=1e-3 * got)
        folded = self.part("soft(4, 1);")
        self.assertGreater(volume(folded), 0)

    def test_half_way_is_half_the_fold_angle(self):
        self.export("pin")
        scene = self.folder / "print/scene.scad"
        scene.write_text(f"use <{self.scad.name}>\necho(theta_deg(0), theta_deg(0.5), theta_deg(1), bodies(), pose(3, 0));\n")
        said = command_output("openscad", "-o", self.folder / "print/out.echo", scene) + (self.folder / "print/out.echo").read_text()
        zero, half, whole, bodies = (float(n) for n in re.search(r"ECHO: (\S+), (\S+), (\S+), (\S+),", said).groups())
        self.assertEqual((zero, bodies), (0, len(self.result.bodies)))
        self.assertAlmostEqual(half, whole / 2, delta=1e-4)
        self.assertIn(", 1, 0, 0, 0]", said)

    def test_the_whole_sheet_renders(self):
        self.export("block")
        scene = self.folder / "print/scene.scad"
        scene.write_text(f"use <{self.scad.name}>\nsheet(1);\n")
        said = command_output("openscad", "-o", self.folder / "print/scene.csg", scene)
        self.assertNotIn("WARNING", said)
        self.assertEqual((self.folder / "print/scene.csg").read_text().count("polyhedron("),
                         len(self.result.bodies) + len(self.result.hinges))


if __name__ == "__main__":
    unittest.main()
