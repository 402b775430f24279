"""blender -b --factory-startup --python probe_cases.py -- FOLDER

Scenes in which the light that reaches probes is known. Probes stand at the origin, but for `far`.
"""
import math
import os
import sys

import bpy
from mathutils import Vector

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import squares  # noqa: E402

SUN = (0.48, 0.36, 0.8)  # the direction that it shines from
WIDE = 1e4  # half the side of a floor without an end
FAR = (1000, -700, 300)


def main(folder):
    for name, build in (("sky", sky), ("black_floor", black_floor), ("lit", lit), ("far", far), ("lamps", lamps),
                        ("pane", pane), ("door", door)):
        squares.empty_dark_scene()
        build()
        bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, name + ".blend"))


def sky(strength=1):
    bpy.context.scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    bpy.context.scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = strength


def black_floor():
    sky()
    square("floor", WIDE, (0, 0, -1), surface("black", "BsdfDiffuse", Color=(0, 0, 0, 1)))


def lit(place=(0, 0, 0)):
    """A floor of albedo 0.5 one unit below `place`, a sky of 0.25 and a sun whose E is pi."""
    sky(0.25)
    sun()
    square("floor", WIDE, Vector(place) - Vector((0, 0, 1)), surface("grey", "BsdfDiffuse", Color=(0.5, 0.5, 0.5, 1)))


def far():
    lit(FAR)


def lamps():
    """Above, a square that glows; below, a lamp of each kind and one that is an instance. The sun shines from below, too."""
    square("glow", 1, (0, 0, 1), surface("glow", "Emission", Strength=1))
    sun(-Vector(SUN))
    hang = Vector((0.3, 0.2, -2))
    for kind in ("POINT", "SPOT", "AREA"):
        add_lamp(kind.lower(), kind, 50, hang).rotation_euler = (math.pi, 0, 0)
    hidden = bpy.data.collections.new("lamps")  # in no scene
    held = bpy.data.objects.new("held", bpy.data.lights.new("held", "POINT"))
    held.data.energy = 50
    hidden.objects.link(held)
    shown = add("instancer", None)
    shown.instance_type, shown.instance_collection, shown.location = "COLLECTION", hidden, -hang + Vector((0, 0, -5))


def pane():
    """Straight sun through a clear pane a millimetre above the probe."""
    sun((0, 0, 1))
    square("pane", 1, (0, 0, 1e-3), surface("clear", "BsdfTransparent"))
    square("pane, turned", 1, (0, 0, 2e-3), surface("clear, too", "BsdfTransparent")).rotation_euler = (math.pi, 0, 0)


def door():
    """Two black roofs under a sky, one of them an instance, which carries a lamp's parent and shades alone."""
    sky()
    black = surface("black", "BsdfDiffuse", Color=(0, 0, 0, 1))
    square("door", WIDE, (0, 0, 1), black)
    hidden = bpy.data.collections.new("lifts")
    lift = square("cabin", WIDE, (0, 0, 2), black)
    bpy.context.scene.collection.objects.unlink(lift)
    hidden.objects.link(lift)
    shown = add("lift", None)
    shown.instance_type, shown.instance_collection = "COLLECTION", hidden


def add(name, data):
    ob = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(ob)
    return ob


def add_lamp(name, kind, energy, place):
    ob = add(name, bpy.data.lights.new(name, kind))
    ob.data.energy, ob.location = energy, place
    return ob


def sun(shines_from=SUN):
    ob = add_lamp("sun", "SUN", math.pi, (0, 0, 0))
    ob.data.angle = 0
    ob.rotation_euler = Vector(shines_from).to_track_quat("Z", "Y").to_euler()


def square(name, half, place, material):
    mesh = squares.mesh_of(name, [[(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)]])
    mesh.materials.append(material)
    ob = add(name, mesh)
    ob.location = place
    return ob


def surface(name, kind, **inputs):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    shader, output = tree.nodes.new("ShaderNode" + kind), tree.nodes.new("ShaderNodeOutputMaterial")
    for socket, value in inputs.items():
        shader.inputs[socket].default_value = value
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    return material


main(*sys.argv[sys.argv.index("--") + 1:])
