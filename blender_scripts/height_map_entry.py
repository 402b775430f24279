"""Bake how much light reaches the texels of a height map. Needs no scene: the driver hands over the surface as
triangles, where its copies lie, and receivers (a tiny horizontal quad over each texel for each direction).

Request: "surface" {"file", "vertices", "triangles"}, "copies" [[sign x, sign y, shift x, shift y]], "receivers"
{"file", "corners"}, "width" and "height" of the picture, "cycles" (see scene_ops/cycles.py), "lamps"
[{"direction", "color"}] with "lamp_distance" and "lamp_radius", and "bakes" [{"light": "sky" or "lamps",
"open": without the surface, "pixels": file}].
"""
import os
import sys
from array import array

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402
from mathutils import Vector  # noqa: E402

from core import task as core_task  # noqa: E402
from core.arrays import read_floats  # noqa: E402
from bake import receivers  # noqa: E402
from scene_ops import cycles  # noqa: E402
from scene_ops.plain_material import empty_tree, new_diffuse  # noqa: E402


def main(task):
    request = task.request
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = make_sky()
    cycles.apply_settings(scene, request["cycles"])
    task.progress("build")
    surface = place_surface(scene, task)
    lamps = place_lamps(scene, request)
    image = cycles.new_float_image("rnmbake height map", request["width"], request["height"])
    with open(task.path(request["receivers"]["file"]), "rb") as stream:
        mesh = receivers.build_mesh("rnmbake receiver", stream, [(request["receivers"]["corners"], True)])
    receiver, _ = receivers.make_receiver(scene, mesh, receivers.make_material(image))
    for number, bake in enumerate(request["bakes"]):
        task.progress("bake", bake["light"], number, len(request["bakes"]), number + 1,
                      cycles.samples_of_picture(scene, request["width"], request["height"]))
        for ob in surface:
            ob.hide_render = bake["open"]
        for lamp in lamps:
            lamp.hide_render = bake["light"] != "lamps"
        set_sky(scene.world, 1 if bake["light"] == "sky" else 0)
        cycles.bake_diffuse(scene, receiver)
        cycles.save_pixels(image, task.path(bake["pixels"]))
    return {}


def make_sky():
    """White above the horizon, black below, found by the receivers' own rays."""
    world = bpy.data.worlds.new("rnmbake sky")
    tree = empty_tree(world)
    nodes, links = tree.nodes, tree.links
    direction = nodes.new("ShaderNodeTexCoord")
    split = nodes.new("ShaderNodeSeparateXYZ")
    above = nodes.new("ShaderNodeMath")
    above.operation = "GREATER_THAN"
    above.inputs[1].default_value = 0
    strength = nodes.new("ShaderNodeMath")
    strength.operation = "MULTIPLY"
    strength.name = "strength"
    background = nodes.new("ShaderNodeBackground")
    background.inputs["Color"].default_value = (1, 1, 1, 1)
    output = nodes.new("ShaderNodeOutputWorld")
    links.new(direction.outputs["Generated"], split.inputs[0])
    links.new(split.outputs["Z"], above.inputs[0])
    links.new(above.outputs[0], strength.inputs[0])
    links.new(strength.outputs[0], background.inputs["Strength"])
    links.new(background.outputs["Background"], output.inputs["Surface"])
    world.cycles.sampling_method = "NONE"
    return world


def set_sky(world, strength):
    world.node_tree.nodes["strength"].inputs[1].default_value = strength


def place_surface(scene, task):
    """Objects that share the one mesh, black so that no light is passed on."""
    mesh = read_surface(task)
    mesh.materials.append(new_diffuse("rnmbake black", (0, 0, 0)))
    placed = []
    for sign_x, sign_y, shift_x, shift_y in task.request["copies"]:
        ob = bpy.data.objects.new("rnmbake surface", mesh)
        ob.scale = (sign_x, sign_y, 1)
        ob.location = (shift_x, shift_y, 0)
        scene.collection.objects.link(ob)
        placed.append(ob)
    return placed


def read_surface(task):
    surface = task.request["surface"]
    mesh = bpy.data.meshes.new("rnmbake surface")
    corners = 3 * surface["triangles"]
    with open(task.path(surface["file"]), "rb") as stream:
        positions = read_floats(stream, 3 * surface["vertices"])
        indices = array("i")
        indices.fromfile(stream, corners)
    mesh.vertices.add(surface["vertices"])
    mesh.loops.add(corners)
    mesh.polygons.add(surface["triangles"])
    mesh.vertices.foreach_set("co", positions)
    mesh.loops.foreach_set("vertex_index", indices)
    mesh.polygons.foreach_set("loop_start", array("i", range(0, corners, 3)))
    if bpy.app.version < (4, 0):
        mesh.polygons.foreach_set("loop_total", array("i", [3]) * surface["triangles"])
    mesh.update(calc_edges=True)
    return mesh


def place_lamps(scene, request):
    """Round area lights that face the origin, where the middle of the map is."""
    lamps = []
    distance, radius = request["lamp_distance"], request["lamp_radius"]
    for lamp in request["lamps"]:
        data = bpy.data.lights.new("rnmbake lamp", "AREA")
        data.shape = "DISK"
        data.size = 2 * radius
        data.color = lamp["color"]
        data.energy = 10 * distance * distance  # a few units of irradiance; the open bake divides it out
        ob = bpy.data.objects.new("rnmbake lamp", data)
        direction = Vector(lamp["direction"])
        ob.location = direction * distance
        ob.rotation_euler = direction.to_track_quat("Z", "Y").to_euler()  # a lamp shines along its -Z
        scene.collection.objects.link(ob)
        lamps.append(ob)
    return lamps


core_task.run(main)
