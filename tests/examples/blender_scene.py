"""Run by Blender: `blender -b --python blender_scene.py -- SCENE.blend...`. Describes each scene in SCENE.json.

Each object has its name, its closed volume, its matrix in the world at the first, middle and last frame, and whether
all its edges have two sides.
"""
import json
import os
import sys

import bmesh
import bpy


def describe_scene():
    scene = bpy.context.scene
    meshes = [thing for thing in bpy.data.objects if thing.type == "MESH"]
    objects = []
    for thing in meshes:
        mesh = bmesh.new()
        mesh.from_mesh(thing.data)
        objects.append({"name": thing.name, "volume_mm3": mesh.calc_volume(signed=True), "matrices": [],
                        "closed": all(edge.is_manifold for edge in mesh.edges)})
        mesh.free()
    for frame in (scene.frame_start, (scene.frame_start + scene.frame_end) // 2, scene.frame_end):
        scene.frame_set(frame)
        for thing, said in zip(meshes, objects):
            said["matrices"].append([list(row) for row in thing.matrix_world])
    return {"objects": objects, "scale": scene.unit_settings.scale_length}


for file in sys.argv[sys.argv.index("--") + 1:]:
    bpy.ops.wm.open_mainfile(filepath=file)
    with open(os.path.splitext(file)[0] + ".json", "w") as out:
        json.dump(describe_scene(), out)
