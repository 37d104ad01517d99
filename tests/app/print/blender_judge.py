"""Reports what Blender finds in a glTF file: `blender -b --factory-startup --python blender_judge.py -- FILE.glb`.

It prints the objects with a mesh, how many of them move, the materials and the last frame. Then it prints the
pose of each object in that frame (rows of its matrix, metres).
"""
import sys

import bpy
import numpy

numpy.bool = bool  # Debian 12: the importer of Blender 3.4 asks for a name that its NumPy has no longer
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=sys.argv[-1])
meshes = [o for o in bpy.data.objects if o.type == "MESH"]
last = max(action.frame_range[1] for action in bpy.data.actions)
bpy.context.scene.frame_set(0)
flat = {o.name: o.matrix_world.copy() for o in meshes}
bpy.context.scene.frame_set(int(last), subframe=last - int(last))
moved = sum(max(abs(a - b) for p, q in zip(o.matrix_world, flat[o.name]) for a, b in zip(p, q)) > 1e-6 for o in meshes)
print("objects", len(meshes), "moved", moved, "materials", len(bpy.data.materials), "last", last)
for o in meshes:
    print("pose", o.name, "|", *(f"{number:.9g}" for row in o.matrix_world[:3] for number in row))
