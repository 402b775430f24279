"""Light that the user adds by words, for scenes that bring none: a sky and a sun.

What is added carries a property, so that a scene that was saved with it, and is opened with the same words, has it once.
"""
from math import cos, radians, sin

import bpy
from mathutils import Vector

ADDED_PROPERTY = "rnmbake light"
DISC = radians(0.526)  # the sun's, and what Blender gives to new suns


def add_light(request):
    """request["sky"]: radiance, 0 for none. request["sun"]: azimuth and elevation in degrees, irradiance; or none."""
    if request.get("sky"):
        set_sky(request["sky"])
    if request.get("sun"):
        set_sun(*request["sun"])


def set_sky(radiance):
    scene, layer = bpy.context.scene, bpy.context.view_layer
    world = added_before(bpy.data.worlds) or bpy.data.worlds.new("rnmbake sky")
    world[ADDED_PROPERTY] = True
    world.use_nodes = True
    background = next(node for node in world.node_tree.nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = (1, 1, 1, 1)
    background.inputs["Strength"].default_value = radiance
    scene.world, layer.use_sky = world, True
    if getattr(layer, "world_override", None):
        layer.world_override = None


def set_sun(azimuth, elevation, irradiance):
    """Azimuths count from +Y over +X."""
    scene = bpy.context.scene
    light = added_before(bpy.data.lights) or bpy.data.lights.new("rnmbake sun", "SUN")
    light[ADDED_PROPERTY] = True
    light.energy, light.angle = irradiance, DISC
    ob = next((ob for ob in scene.objects if ob.data == light), None)  # a lambert scene has one of its own
    if ob is None:
        ob = bpy.data.objects.new("rnmbake sun", light)
        scene.collection.objects.link(ob)
    azimuth, elevation = radians(azimuth), radians(elevation)
    towards = Vector((sin(azimuth) * cos(elevation), cos(azimuth) * cos(elevation), sin(elevation)))
    ob.matrix_world = towards.to_track_quat("Z", "Y").to_matrix().to_4x4()
    bpy.context.view_layer.update()


def added_before(blocks):
    return next((block for block in blocks if ADDED_PROPERTY in block), None)
