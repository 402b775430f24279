"""blender -b --factory-startup --python glow_cases.py -- FILE

Strips of four unit squares, black, of which the first glows green from both sides, and a speck one unit above the
middle of that which faces it; near the origin and far from it, flat and turned. A red sun shines straight
down.
"""
import os
import sys

import bpy
from mathutils import Euler, Matrix, Vector

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import squares  # noqa: E402

# Distance from the origin, sideways; height; turn. Each stands under the horizons of the others, but for the last.
PLACES = {"here": (0, 0, (0, 0, 0)), "turned": (100, -10, (0.3, 0.7, 1.1)), "km": (1000, -200, (0.3, 0.7, 3.1)),
          "far": (1e5, 3e4, (0, 0, 0))}


def main(path):
    squares.empty_dark_scene()
    sun = bpy.data.lights.new("sun", "SUN")
    sun.color, sun.energy, sun.angle = (1, 0, 0), 3.14159265, 0
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("sun", sun))
    black = material("black")
    for name, (distance, height, turn) in PLACES.items():
        normal = Euler(turn).to_matrix().col[2]
        sideways = Vector((normal.x, normal.y, 0)).normalized() if normal.z < 0.999 else Vector((1, 0, 0))
        to_world = Matrix.LocRotScale(distance * sideways + Vector((0, 0, height)), Euler(turn), None)
        strip = [[(x, 0, 0), (x + 1, 0, 0), (x + 1, 1, 0), (x, 1, 0)] for x in range(4)]
        add("strip " + name, strip, to_world, material("glow " + name, 2), black)
        if name == "far":
            continue  # floats are too coarse for it there
        a, b = 0.499, 0.501
        add("speck " + name, [[(a, a, 1), (a, b, 1), (b, b, 1), (b, a, 1)]], to_world, black)
    bpy.ops.wm.save_as_mainfile(filepath=path)


def material(name, strength=0):
    """Black; Principled, so that emission is one of its inputs."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    inputs = made.node_tree.nodes["Principled BSDF"].inputs
    for socket, value in (("Base Color", (0, 0, 0, 1)), ("Specular", 0), ("Specular IOR Level", 0),
                          ("Emission", (0, 1, 0, 1)), ("Emission Color", (0, 1, 0, 1)), ("Emission Strength", strength)):
        if socket in inputs:
            inputs[socket].default_value = value
    return made


def add(name, quads, to_world, *materials):
    """Of the quads the first has the first material, the others the last."""
    mesh = squares.mesh_of(name, quads)
    for each in materials:
        mesh.materials.append(each)
    for polygon in mesh.polygons:
        polygon.material_index = min(polygon.index, len(materials) - 1)
    ob = bpy.data.objects.new(name, mesh)
    ob.matrix_world = to_world
    bpy.context.scene.collection.objects.link(ob)


main(sys.argv[-1])
