"""Statues of 15,744 triangles each, in rows of four under a sky and a sun, with the UVs that Blender gives Suzanne.

    blender -b --factory-startup --python make_statues.py -- STATUES OUTPUT.blend
"""
import os
import sys

import bpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../blender_scripts"))
sys.dont_write_bytecode = True

from scene_ops.plain_material import new_diffuse  # noqa: E402

SUBDIVISIONS = 2
PER_ROW, DISTANCE = 4, 3.0


def add_statue():
    bpy.ops.mesh.primitive_monkey_add()
    statue = bpy.context.object
    smooth = statue.modifiers.new("smooth", "SUBSURF")
    smooth.levels = smooth.render_levels = SUBDIVISIONS
    bpy.ops.object.modifier_apply(modifier=smooth.name)
    bpy.ops.object.shade_smooth()
    statue.data.materials.append(new_diffuse("statue", (0.6, 0.6, 0.6)))
    return statue


def copy(statue, number):
    """Each has a mesh of its own."""
    other = statue.copy()
    other.data = statue.data.copy()
    other.name = f"statue{number}"
    other.location = (DISTANCE * (number % PER_ROW), DISTANCE * (number // PER_ROW), 0)
    bpy.context.scene.collection.objects.link(other)


def add_lights():
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    bpy.context.scene.world = world
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.rotation_euler = (0.6, 0.4, 0)
    bpy.context.scene.collection.objects.link(sun)


def main():
    statues, output = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    add_lights()
    first = add_statue()
    first.name = "statue0"
    for number in range(1, int(statues)):
        copy(first, number)
    bpy.ops.wm.save_as_mainfile(filepath=output)


main()
