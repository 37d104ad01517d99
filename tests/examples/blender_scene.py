"""Run by Blender on a scene: `blender -b SCENE.blend --python blender_scene.py -- OUT.json`. Writes for each object
its name, its matrix in the world at the first, middle and last frame, its closed volume, and whether all its
edges have two sides."""
import json
import sys

import bmesh
import bpy

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
with open(sys.argv[-1], "w") as out:
    json.dump({"objects": objects, "scale": scene.unit_settings.scale_length}, out)
