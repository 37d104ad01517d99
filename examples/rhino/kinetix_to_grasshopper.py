"""Script of a GHPython component of Grasshopper in Rhino: the bodies of a result.json, folded by a slider.

Inputs   file    text: the path of a result.json.
         folder  text: the folder of kinetix_reader.py, which is above this file.
         part    number: 0 (flat) to 1 (folded).
Outputs  meshes  a closed mesh per body, in mm.
         names   their names, in the same order.
         axes    a line along each hinge.
         groups  "class A" or "class B" per body, for layers: its sense of rotation.

Not tested in Rhino itself: the tests cover everything except in_rhino(), the only function that uses Rhino.
"""
import sys


def shapes(reader, result, part):
    """Returns the corners and sides of each body at a part of the motion."""
    poses = result.poses_at(part)
    out = []
    for body, pose in zip(result.bodies, poses):
        corners, sides = [], []
        for box in body.boxes:
            sides += [[len(corners) + corner for corner in side] for side in reader.BOX_SIDES]
            corners += [pose.carry(corner) for corner in box]
        out.append((corners, sides))
    return out


def hinge_lines(reader, result, part):
    """Returns both ends of each hinge, moved with its first body."""
    poses, lines = result.poses_at(part), []
    for hinge in result.hinges:
        body = hinge["bodies"][0]
        arm = reader.add(hinge["point_mm"], reader.times(-1, result.bodies[body].rest))
        half = reader.times(hinge["reach_mm"], hinge["axis"])
        lines.append([poses[body].carry(reader.add(arm, end)) for end in (half, reader.times(-1, half))])
    return lines


def classes(result):
    """Returns the class of each body, starting with the first. Neighbours turn in opposite directions."""
    neighbours = [[] for _ in result.bodies]
    for hinge in result.hinges:
        a, b = hinge["bodies"]
        neighbours[a].append(b)
        neighbours[b].append(a)
    of = [None] * len(neighbours)
    for first in range(len(of)):
        todo = [first] if of[first] is None else []
        of[first] = of[first] or "class A"
        while todo:
            body = todo.pop()
            for other in neighbours[body]:
                if of[other] is None:
                    of[other] = "class B" if of[body] == "class A" else "class A"
                    todo.append(other)
    return of


def in_rhino(reader, result, part):
    from Rhino.Geometry import Line, Mesh, Point3d
    made = []
    for corners, sides in shapes(reader, result, part):
        mesh = Mesh()
        for corner in corners:
            mesh.Vertices.Add(*corner)
        for side in sides:
            mesh.Faces.AddFace(*side)
        mesh.Normals.ComputeNormals()
        made.append(mesh)
    return made, [Line(Point3d(*a), Point3d(*b)) for a, b in hinge_lines(reader, result, part)]


if "file" in globals() and "part" in globals():  # a component with these inputs
    sys.path.insert(0, folder)  # noqa: F821
    import kinetix_reader
    of_file = kinetix_reader.Result(file)  # noqa: F821
    meshes, axes = in_rhino(kinetix_reader, of_file, part)  # noqa: F821
    names, groups = [body.name for body in of_file.bodies], classes(of_file)
