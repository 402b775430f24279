"""blender -b --factory-startup --python probe_rooms.py -- FOLDER

rooms.blend: two rooms with a door in their common wall, a lamp in one, a ball that moves, one of Blender's light probe
volumes, and empties. inside_out.blend: a box whose faces point outwards. empty.blend: a sun alone. dark.blend: a room
without light. full.blend: a lit room that has no place for another UV layer.
"""
import os
import sys

import bpy
from mathutils import Matrix

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import squares  # noqa: E402


def main(folder):
    for name, build in (("rooms", rooms), ("inside_out", inside_out), ("empty", empty), ("dark", dark),
                        ("full", full)):
        squares.empty_dark_scene()
        build()
        bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, name + ".blend"))


def box(name, low, high, inwards=False):
    bpy.ops.mesh.primitive_cube_add(size=1)
    ob = bpy.context.object
    ob.name = name
    ob.data.transform(Matrix.Diagonal([b - a for a, b in zip(low, high)] + [1]))
    ob.data.transform(Matrix.Translation([(a + b) / 2 for a, b in zip(low, high)]))
    if inwards:
        ob.data.flip_normals()
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.7, 0.7, 0.7, 1)
    ob.data.materials.append(material)
    return ob


def rooms():
    box("shell", (0, 0, 0), (8, 4, 3), inwards=True)
    for name, low, high in (("left of the door", (3.9, 0, 0), (4.1, 1.5, 3)), ("right of it", (3.9, 2.5, 0), (4.1, 4, 3)),
                            ("over it", (3.9, 1.5, 2), (4.1, 2.5, 3))):
        box(name, low, high)
    lamp = bpy.data.objects.new("lamp", bpy.data.lights.new("lamp", "POINT"))
    lamp.data.energy = 200
    lamp.data.shadow_soft_size = 0.1
    lamp.location = (2, 2, 2.5)
    bpy.context.scene.collection.objects.link(lamp)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.4, location=(5.2, 2, 1))
    bpy.context.object.name = "ball"
    bpy.ops.object.shade_smooth()
    for number in range(2):
        bpy.ops.object.empty_add(location=(1 + 5 * number, 1, 1))
        bpy.context.object.name = f"spot {number}"
    bpy.ops.object.lightprobe_add(type="GRID" if bpy.app.version < (4, 1) else "VOLUME", location=(4, 2, 1.5))
    volume = bpy.context.object
    volume.name, volume.scale = "light volume", (4, 2, 1.5)
    prefix = "resolution_" if hasattr(volume.data, "resolution_x") else "grid_resolution_"
    for axis, count in zip("xyz", (8, 4, 3)):
        setattr(volume.data, prefix + axis, count)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.matrix_world = Matrix.Translation((7.5, 2, 1)) @ Matrix.Rotation(1.5708, 4, "Z") @ Matrix.Rotation(1.5708, 4, "X")
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def inside_out():
    box("box", (-2, -2, -2), (2, 2, 2))
    sun()


def empty():
    sun()


def dark():
    return box("shell", (-2, -2, -2), (2, 2, 2), inwards=True)


def full():
    layers = dark().data.uv_layers
    while len(layers) < 8:
        layers.new()
    for layer in layers:
        layer.data.foreach_set("uv", [0] * (2 * len(layer.data)))
    bpy.ops.object.light_add(type="POINT")


def sun():
    ob = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    bpy.context.scene.collection.objects.link(ob)


main(sys.argv[sys.argv.index("--") + 1])
