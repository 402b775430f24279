"""A floor, a wall with a picture beside the scene, a box and a lamp: blender -b [SCENE] --python reuse_scene.py -- FILE [CHANGE]

Without CHANGE the scene is made; else SCENE is open, and saved to FILE with that change."""
import os
import sys

import bpy

FILE, *CHANGE = sys.argv[sys.argv.index("--") + 1:]


def picture(path, color):
    image = bpy.data.images.new("wall", 8, 8)
    image.pixels[:] = [*color, 1.0] * 64
    image.filepath_raw, image.file_format = path, "PNG"
    image.save()
    bpy.data.images.remove(image)


def material(name, image=None):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    if image:
        node = made.node_tree.nodes.new("ShaderNodeTexImage")
        node.image = image
        made.node_tree.links.new(node.outputs["Color"], made.node_tree.nodes["Principled BSDF"].inputs["Base Color"])
    return made


def build():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    path = os.path.join(os.path.dirname(FILE), "wall.png")
    picture(path, (0.8, 0.4, 0.2))
    for name, place, turn in (("floor", (0, 0, 0), (0, 0, 0)), ("wall", (0, 1, 1), (1.5707963, 0, 0))):
        bpy.ops.mesh.primitive_plane_add(location=place, rotation=turn)
        bpy.context.object.name = name
    bpy.data.objects["wall"].data.materials.append(material("wall", bpy.data.images.load(path)))
    bpy.data.images["wall.png"].filepath = "//wall.png"
    bpy.ops.mesh.primitive_cube_add(size=0.6, location=(0.2, 0, 0.4))
    bpy.context.object.name = "box"
    bpy.context.object.data.materials.append(material("box"))
    bpy.ops.object.light_add(type="AREA", location=(0, -0.5, 2))
    bpy.context.object.name = "lamp"
    bpy.data.lights[0].energy = 60


def change(what):
    if what == "selection":
        for ob in bpy.context.view_layer.objects:
            ob.select_set(ob.name == "box")
        bpy.context.view_layer.objects.active = bpy.data.objects["box"]
    elif what == "lamp":
        bpy.data.lights[0].energy = 30
    elif what == "picture":
        picture(os.path.join(os.path.dirname(FILE), "wall.png"), (0.1, 0.4, 0.9))
    elif what == "no box":
        bpy.data.objects.remove(bpy.data.objects["box"])
    else:
        raise ValueError(what)


if CHANGE:
    change(*CHANGE)
else:
    build()
bpy.ops.wm.save_as_mainfile(filepath=FILE)
