"""render_rib.py, run by Blender: a rendering of an exported sheet, flat and folded on a table.

    kinetix-opt export results/helmet_rib --format glb -o print
    blender -b --factory-startup --python docs/figures/render_rib.py -- print/helmet_rib.glb docs/figures/rib_rendering.jpg
"""
import math
import re
import sys

import bpy
import numpy
from mathutils import Matrix, Vector

WIDTH, HEIGHT = 1200, 560  # px
SAMPLES = 24  # of each pixel: grain that is left looks like a camera's
GAP = 0.025  # m, from the flat sheet to the folded one

numpy.bool = bool  # Debian 12: the importer of Blender 3.4 asks for a name that its NumPy has no longer


def sheet(file, last):
    """All parts, at rest in the first or last frame of the file's motion."""
    before = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=file)
    new = [o for o in bpy.data.objects if o not in before]
    frame = max(a.frame_range[1] for a in bpy.data.actions) if last else 0
    bpy.context.scene.frame_set(int(frame), subframe=frame - int(frame))
    parts = sorted((o for o in new if o.type == "MESH"), key=lambda o: [int(n) for n in re.findall(r"\d+", o.name)])
    places = [o.matrix_world.copy() for o in parts]
    for part, place in zip(parts, places):
        part.animation_data_clear()
        part.parent = None
        part.matrix_world = place
    return parts


def corners(parts):
    return [p.matrix_world @ Vector(c) for p in parts for c in p.bound_box]


def move(parts, matrix):
    for part in parts:
        part.matrix_world = matrix @ part.matrix_world


def put(parts, y):
    """On the table, in the middle of x, behind the line y."""
    all_ = corners(parts)
    low, high = [[f(p[k] for p in all_) for k in range(3)] for f in (min, max)]
    move(parts, Matrix.Translation((-(low[0] + high[0]) / 2, y - low[1], -low[2])))
    return y + high[1] - low[1]


def standing(parts):
    """An arch on its ends, which are the first and the last part."""
    first, last = (part.matrix_world.to_translation() for part in (parts[0], parts[-1]))
    move(parts, Matrix.Rotation(math.atan2(last.z - first.z, last.x - first.x), 4, "Y"))
    end, middle = (parts[k].matrix_world.to_translation() for k in (0, len(parts) // 2))
    if end.z > middle.z:
        move(parts, Matrix.Rotation(math.pi, 4, "X"))


def material(name, colour, roughness):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1)
    shader.inputs["Roughness"].default_value = roughness
    return made


def table_and_light():
    bpy.ops.mesh.primitive_plane_add(size=4)
    bpy.context.object.data.materials.append(material("table", (0.23, 0.17, 0.12), 0.6))
    bpy.ops.object.light_add(type="SUN", rotation=(math.radians(48), math.radians(12), math.radians(35)))
    bpy.context.object.data.energy, bpy.context.object.data.angle = 3.5, math.radians(4)
    world = bpy.data.worlds.new("room")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs[0].default_value = (0.62, 0.7, 0.8, 1)
    world.node_tree.nodes["Background"].inputs[1].default_value = 0.55
    bpy.context.scene.world = world


def camera(parts):
    """From the front and above, as near as shows everything."""
    bpy.ops.object.camera_add(rotation=(math.radians(58), 0, math.radians(8)))
    eye = bpy.context.object
    bpy.context.scene.camera = eye
    eye.data.lens = 60  # mm: little perspective
    flat_list = [number for p in corners(parts) for number in p]
    where, _ = eye.camera_fit_coords(bpy.context.evaluated_depsgraph_get(), flat_list)
    away = eye.matrix_world.to_quaternion() @ Vector((0, 0, 1))
    eye.location = where + 0.03 * away


bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
source, target = sys.argv[-2:]
flat, folded = sheet(source, False), sheet(source, True)
plastic = (material("forks", (0.80, 0.78, 0.72), 0.45), material("eyes", (0.16, 0.30, 0.48), 0.45))
for parts in (flat, folded):
    for k, part in enumerate(parts):
        part.data = part.data.copy()  # bodies of one shape share it
        if len(part.data.materials) == 1:
            part.data.materials[0] = plastic[sum(int(n) for n in part.name.split("[")[-1].split("]")[0].split(",")) % 2] \
                if "[" in part.name else plastic[1]
standing(folded)
put(folded, put(flat, 0) + GAP)
table_and_light()
camera(flat + folded)
scene.render.engine = "CYCLES"
scene.cycles.device, scene.cycles.samples, scene.cycles.seed = "CPU", SAMPLES, 1
scene.cycles.use_denoising = False
scene.view_settings.view_transform = "Filmic"
scene.render.image_settings.file_format = "JPEG"  # a tenth of the grain's bytes in PNG
scene.render.image_settings.color_mode = "RGB"
scene.render.image_settings.quality = 88
scene.render.filepath = target
bpy.ops.render.render(write_still=True)
