"""Blender runs this: saves a scene whose light comes from one side, on surfaces that look every way.

    blender -b --factory-startup --python axes_scene.py -- FILE [NAME]

A floor, a tilted box with a name that engines change, a tilted panel with a normal map of one colour, a child of an empty,
and a smooth sphere behind the camera. NAME: of one cube more.
"""
import math
import sys

import bpy
from mathutils import Vector

FILE, *NAMES = sys.argv[sys.argv.index("--") + 1:]
NORMAL = Vector((.35, -.25, 1)).normalized()  # what the panel's normal map holds everywhere


def matt(name, colour):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    surface = material.node_tree.nodes["Principled BSDF"]
    surface.inputs["Base Color"].default_value = (*colour, 1)
    (surface.inputs.get("Specular IOR Level") or surface.inputs["Specular"]).default_value = 0
    return material


def with_normal_map(material):
    image = bpy.data.images.new("slant", 4, 4)
    image.colorspace_settings.name = "Non-Color"
    image.pixels[:] = [*(part / 2 + .5 for part in NORMAL), 1] * 16
    image.pack()
    nodes, links = material.node_tree.nodes, material.node_tree.links
    texture, normal = nodes.new("ShaderNodeTexImage"), nodes.new("ShaderNodeNormalMap")
    texture.image = image
    links.new(texture.outputs["Color"], normal.inputs["Color"])
    links.new(normal.outputs["Normal"], nodes["Principled BSDF"].inputs["Normal"])
    return material


def placed(name, material, **where):
    ob = bpy.context.object
    ob.name = name
    ob.data.materials.append(material)
    for key, value in where.items():
        setattr(ob, key, value)
    return ob


bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.resolution_x, scene.render.resolution_y = 240, 150
bpy.ops.mesh.primitive_plane_add(size=6)
placed("floor", matt("grey", (.6, .6, .6)))
bpy.ops.mesh.primitive_cube_add(size=1.2, location=(-1.2, 0, 1.4), rotation=(.5, .4, .3))
placed("box.001", matt("red", (.8, .4, .3)))
bpy.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=16, radius=.9, location=(0, -10, 1.4))
bpy.ops.object.shade_smooth()
placed("ball", matt("white", (.8, .8, .8)))
bpy.ops.mesh.primitive_plane_add(size=1.8, location=(1.2, .4, 1.3), rotation=(math.radians(65), 0, math.radians(25)))
panel = placed("panel", with_normal_map(matt("blue", (.4, .5, .8))))
group = bpy.data.objects.new("group: right", None)
scene.collection.objects.link(group)
panel.parent = group
for name in NAMES:
    bpy.ops.mesh.primitive_cube_add(size=.4, location=(0, -1.5, .2))
    placed(name, bpy.data.materials["white"])

sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.data.energy, sun.data.color, sun.data.angle = 3, (1, .8, .6), .1
sun.rotation_euler = Vector((.5, 1, -1)).to_track_quat("-Z", "Y").to_euler()
scene.collection.objects.link(sun)
scene.world = bpy.data.worlds.new("sky")
scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (.2, .3, .5, 1)
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location = (.6, -7, 3.2)
camera.rotation_euler = (Vector((0, 0, .9)) - camera.location).to_track_quat("-Z", "Y").to_euler()
scene.collection.objects.link(camera)
scene.camera = camera
bpy.ops.wm.save_as_mainfile(filepath=FILE)
