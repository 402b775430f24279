"""Equal planes under two suns; one sun is linked to the first plane, and to the empty that places another.
blender ... -- OUT.blend"""
import math
import sys

import bpy


def plane(name, x):
    bpy.ops.mesh.primitive_plane_add(size=1, location=(x, 0, 0))
    ob = bpy.context.object
    ob.name = name
    ob.data.uv_layers[0].name = "Lightmap"
    material = bpy.data.materials.new(name)
    if not material.use_nodes:
        material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    diffuse, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(diffuse.outputs["BSDF"], output.inputs["Surface"])
    ob.data.materials.append(material)
    return ob


def sun(name):
    light = bpy.data.lights.new(name, "SUN")
    light.energy, light.angle = math.pi, 0
    ob = bpy.data.objects.new(name, light)
    bpy.context.scene.collection.objects.link(ob)
    return ob


for old in list(bpy.data.objects):
    bpy.data.objects.remove(old)
world = bpy.data.worlds.new("black")
world.color = (0, 0, 0)
if world.use_nodes:
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
bpy.context.scene.world = world
chosen = plane("chosen", -2)
plane("other", 2)
sun("for all")
linked = sun("for one")
collection = bpy.data.collections.new("lit by one")
collection.objects.link(chosen)
things = bpy.data.collections.new("things")
placed = plane("placed", 0)
placed.users_collection[0].objects.unlink(placed)
things.objects.link(placed)
row = bpy.data.objects.new("row", None)
row.instance_type, row.instance_collection, row.location.y = "COLLECTION", things, 5
bpy.context.scene.collection.objects.link(row)
collection.objects.link(row)
linked.light_linking.receiver_collection = collection
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
