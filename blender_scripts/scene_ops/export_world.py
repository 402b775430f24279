"""The world as radiance: one colour, or the picture that Cycles itself makes of it.

The picture is a panorama of an empty scene, so sky textures, environment pictures and any node tree come out as
Cycles shows them to a diffuse bounce.
"""
import math
import os

import bpy

from scene_ops.describe import describe_world
from scene_ops.describe_nodes import reachable_nodes, tree_source
from scene_ops.export_looks import write_pixels

WIDTH = 2048  # across the horizon: three pixels for a sun of half a degree
SAMPLES = 64
BLACK = [0.0, 0.0, 0.0]

# What a diffuse bounce gets from a Light Path node; everything else that it asks is 0.
BOUNCE = {"Is Diffuse Ray": 1.0, "Is Reflection Ray": 1.0, "Ray Depth": 1.0, "Diffuse Depth": 1.0}


def describe(task, scene, file):
    """(World of scene/exchange.h, entry of its picture or None, what cannot be carried)."""
    world = scene.world
    known = describe_world(world)
    if known["kind"] == "none":
        return {"radiance": BLACK, "picture": -1}, None, []
    if not getattr(getattr(world, "cycles_visibility", None), "diffuse", True):
        return {"radiance": BLACK, "picture": -1}, None, ["seen by cameras only"]
    outside = sorted(outside_of(world))
    if known["kind"] == "constant":
        radiance = [max(0.0, known["strength"] * value) for value in known["color"]]
        return {"radiance": radiance, "picture": -1}, None, outside
    task.progress("world", world.name)
    entry = render(task, scene, file)
    return {"radiance": BLACK, "picture": 0}, entry, outside


def outside_of(world):
    if not world.use_nodes or world.node_tree is None:
        return
    outputs = [node for node in world.node_tree.nodes if node.type == "OUTPUT_WORLD" and node.is_active_output]
    if outputs and outputs[0].inputs["Volume"].is_linked:
        yield "volume"
    if outputs and any(node.type == "LIGHT_PATH" for node in reachable_nodes(outputs[0].inputs["Surface"])):
        yield "light path"


def render(task, like, file):
    """The entry of the panorama, whose pixels go into the file."""
    scene = bpy.data.scenes.new("rnmbake world")
    scene.frame_current = like.frame_current
    scene.world = as_a_bounce_sees_it(like.world)
    scene.camera = bpy.data.objects.new("rnmbake panorama", panorama_camera())
    # The middle of the picture is +x and its top +z, as in an environment texture.
    scene.camera.rotation_euler = (math.pi / 2, 0, -math.pi / 2)
    scene.collection.objects.link(scene.camera)
    path = task.path("world.exr")
    settle(scene, path)
    bpy.ops.render.render(write_still=True, scene=scene.name)
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    width, height, offset = write_pixels(file, image)
    bpy.data.images.remove(image)
    bpy.data.scenes.remove(scene)
    os.remove(path)
    return {"width": width, "height": height, "form": "f32", "offset": offset, "name": "world"}


def panorama_camera():
    camera = bpy.data.cameras.new("rnmbake panorama")
    camera.type = "PANO"
    owner = camera if hasattr(camera, "panorama_type") else camera.cycles  # <= 4.x
    owner.panorama_type = "EQUIRECTANGULAR"
    return camera


def settle(scene, path):
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = WIDTH, WIDTH // 2, 100
    render.film_transparent = render.use_compositing = render.use_sequencer = False
    render.filepath, render.use_file_extension = path, False
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.image_settings.color_mode = "RGB"
    cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = SAMPLES, False, False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.film_exposure = 1
    cycles.pixel_filter_type = "BOX"  # the mean over the pixel


def as_a_bounce_sees_it(world):
    """A copy without volume, in which Light Path nodes answer as they do to a diffuse bounce."""
    copy = world.copy()
    for node in copy.node_tree.nodes:
        if node.type == "OUTPUT_WORLD":
            for link in list(node.inputs["Volume"].links):
                copy.node_tree.links.remove(link)
    if any(node.type == "LIGHT_PATH" for node in reachable_nodes(tree_surface(copy.node_tree))):
        answer_light_paths(copy.node_tree)
    return copy


def tree_surface(tree):
    source = tree_source(tree, "OUTPUT_WORLD")
    return next(node for node in tree.nodes if node.type == "OUTPUT_WORLD" and any(
        link.from_node == source for link in node.inputs["Surface"].links)).inputs["Surface"]


def answer_light_paths(tree):
    for node in list(tree.nodes):
        if node.type == "GROUP" and node.node_tree:
            node.node_tree = node.node_tree.copy()
            answer_light_paths(node.node_tree)
        elif node.type == "LIGHT_PATH":
            answer(tree, node)


def answer(tree, node):
    for output in node.outputs:
        value = tree.nodes.new("ShaderNodeValue")
        value.outputs[0].default_value = BOUNCE.get(output.name, 0.0)
        for link in list(output.links):
            tree.links.new(value.outputs[0], link.to_socket)
