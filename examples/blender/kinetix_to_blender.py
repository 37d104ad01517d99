"""Makes a Blender scene of a result.json: an object a body, with keyframes from flat to the goal.

    blender --background --factory-startup --python kinetix_to_blender.py -- RESULT.json -o SCENE.blend

Options: --model bullet (or equilibrium, exact) ends the motion in the state of that model; --frames N between two
steps (10). In Blender's text editor: import kinetix_to_blender, then kinetix_to_blender.build("result.json").
A unit of the scene is a millimetre.
"""
import argparse
import os
import sys
import time

import bpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import kinetix_reader  # noqa: E402

CURVES = [("location", 3), ("rotation_quaternion", 4)]  # of each object, with their numbers


def mesh_of(body, material):
    corners, sides = [], []
    for box in body.boxes:
        sides += [[len(corners) + corner for corner in side] for side in kinetix_reader.BOX_SIDES]
        corners += box
    mesh = bpy.data.meshes.new(body.name)
    mesh.from_pydata(corners, [], sides)
    mesh.materials.append(material)
    return mesh


def animate(thing, poses, frames):
    """Adds linear keyframes through poses, `frames` apart, from frame 0. Blender keeps 32-bit numbers."""
    thing.rotation_mode = "QUATERNION"
    thing.location, thing.rotation_quaternion = poses[-1].position, poses[-1].quaternion
    action = bpy.data.actions.new(thing.name)
    thing.animation_data_create().action = action
    rows = [pose.position + pose.quaternion for pose in poses]
    for column, (path, index) in enumerate((path, i) for path, count in CURVES for i in range(count)):
        points = action.fcurves.new(path, index=index).keyframe_points
        points.add(len(rows))
        points.foreach_set("co", [number for k, row in enumerate(rows) for number in (k * frames, row[column])])
        points.foreach_set("interpolation", [1] * len(rows))  # linear


def build(path, model=None, frames=10):
    """Makes the objects of a result, in its order of bodies, in a collection of its name."""
    result = kinetix_reader.Result(path)
    steps = list(result.steps)
    if model is not None:
        if model not in result.targets:
            raise SystemExit("no state by %s; there are: %s" % (model, ", ".join(sorted(result.targets))))
        kinetix_reader.keep_signs(steps[-1], result.targets[model])
        steps[-1] = result.targets[model]
    collection = bpy.data.collections.new(result.name)
    scene = bpy.context.scene
    scene.collection.children.link(collection)
    scene.unit_settings.scale_length = 0.001
    scene.unit_settings.length_unit = "MILLIMETERS"
    scene.frame_start, scene.frame_end = 0, frames * (len(steps) - 1)
    material = bpy.data.materials.new("walls")
    material.diffuse_color = (0.35, 0.55, 0.8, 1)
    things = []
    for number, body in enumerate(result.bodies):
        thing = bpy.data.objects.new(body.name, mesh_of(body, material))
        animate(thing, [poses[number] for poses in steps], frames)
        collection.objects.link(thing)
        things.append(thing)
    scene.frame_set(scene.frame_end)
    return things


def main(arguments):
    parser = argparse.ArgumentParser(prog="kinetix_to_blender.py", description=__doc__.split("\n")[0])
    parser.add_argument("result")
    parser.add_argument("-o", required=True, metavar="SCENE.blend")
    parser.add_argument("--model", choices=["exact", "equilibrium", "bullet"])
    parser.add_argument("--frames", type=int, default=10)
    options = parser.parse_args(arguments)
    begin = time.time()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    things = build(options.result, options.model, options.frames)
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(options.o))
    print("kinetix: %d bodies in %.2f s, written to %s" % (len(things), time.time() - begin, options.o))


if __name__ == "__main__" and "--" in sys.argv:
    main(sys.argv[sys.argv.index("--") + 1:])
