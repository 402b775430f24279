"""The world as radiance: one colour, or the picture that Cycles itself makes of it.

The picture is a panorama of an empty scene, so sky textures, environment pictures and any node tree come out as
Cycles shows them to a diffuse bounce.
"""
import math
import os

import bpy

from export.looks import read_colors
from scene_ops import light_paths
from scene_ops.describe import NO_LIMIT, describe_world
from scene_ops.describe_nodes import reachable_nodes, tree_source

WIDTH = 2048  # across the horizon: three texels for a sun of half a degree
HEIGHT = WIDTH // 2
SAMPLES = 16
# A sun is a few texels that hold most of the light: all around such ones is rendered again, with more samples.
BRIGHT = 1e-4  # of the whole world's light, in one texel
SAMPLES_AROUND, MOST_SAMPLES = 4096, 1 << 26  # for a texel; for all of them
RIM = 2  # texels
BLACK = [0.0, 0.0, 0.0]


def describe(task, scene, file):
    """(World of scene/diffuse_scene.h, entry of its picture or None, what cannot be carried)."""
    world = world_of(bpy.context.view_layer)
    known = describe_world(world)
    outside = sorted(outside_of(world, known["kind"])) if world else []
    if known["kind"] == "none" or not lights_surfaces(world):
        return {"radiance": BLACK, "picture": -1}, None, outside
    if known["kind"] == "constant":
        radiance = [known["strength"] * value for value in known["color"]]
        return {"radiance": radiance, "picture": -1}, None, outside
    task.progress("world", world.name)
    entry = render(task, scene, world, file)
    return {"radiance": BLACK, "picture": 0}, entry, outside


def world_of(view_layer):
    """The world that Cycles renders; None for a view layer without Environment."""
    if not view_layer.use_sky:
        return None
    return getattr(view_layer, "world_override", None) or bpy.context.scene.world


def lights_surfaces(world):
    return getattr(getattr(world, "cycles_visibility", None), "diffuse", True)


def outside_of(world, kind):
    if not world.use_nodes or world.node_tree is None:
        return
    outputs = [node for node in world.node_tree.nodes if node.type == "OUTPUT_WORLD" and node.is_active_output]
    if outputs and outputs[0].inputs["Volume"].is_linked:
        yield "volume"
    if not lights_surfaces(world):
        return
    if outputs and light_paths.unsure(reachable_nodes(outputs[0].inputs["Surface"]), False):
        yield "light path"
    # Beyond them Cycles goes on to meet the world by chance, with the weight that looking for it leaves.
    if kind != "constant" and world.cycles.sampling_method != "NONE" and world.cycles.max_bounces < NO_LIMIT:
        yield "max bounces"


def render(task, like, world, file):
    """The entry of the panorama, whose pixels go into the file."""
    scene = bpy.data.scenes.new("rnmbake world")
    scene.frame_current = like.frame_current
    scene.world = as_a_bounce_sees_it(world)
    scene.camera = bpy.data.objects.new("rnmbake panorama", panorama_camera())
    # The middle of the picture is +x and its top +z, as in an environment texture.
    scene.camera.rotation_euler = (math.pi / 2, 0, -math.pi / 2)
    scene.collection.objects.link(scene.camera)
    settle(scene)
    colors = expose(task, scene, SAMPLES)
    box = bright_box(colors)
    if box:
        refine(task, scene, colors, box)
    bpy.data.scenes.remove(scene)
    return {"width": WIDTH, "height": HEIGHT, "form": "f32", "offset": file.append(colors), "name": "world"}


def expose(task, scene, samples):
    """Render once: RGB, top row first."""
    path = task.path("world.exr")
    scene.render.filepath, scene.cycles.samples = path, samples
    bpy.ops.render.render(write_still=True, scene=scene.name)
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    colors = read_colors(image)
    bpy.data.images.remove(image)
    os.remove(path)
    return colors


def bright_box(colors):
    """(left, top, right, bottom) around all texels that hold much of the light; None where it is spread evenly."""
    rows = [colors[3 * WIDTH * row:3 * WIDTH * (row + 1)] for row in range(HEIGHT)]
    shares = [math.sin(math.pi * (row + 0.5) / HEIGHT) for row in range(HEIGHT)]  # of solid angle
    total = math.fsum(share * math.fsum(map(abs, row)) for row, share in zip(rows, shares))
    found = [(3 * total * BRIGHT / share, number) for number, share in enumerate(shares)]
    found = [(least, number) for least, number in found if 0 < least < max(rows[number])]
    if not found:
        return None
    columns = {place // 3 for least, number in found for place, value in enumerate(rows[number]) if value > least}
    return (max(min(columns) - RIM, 0), max(found[0][1] - RIM, 0),
            min(max(columns) + RIM + 1, WIDTH), min(found[-1][1] + RIM + 1, HEIGHT))


def refine(task, scene, colors, box):
    """Render the inside of the box again."""
    left, top, right, bottom = box
    render = scene.render
    render.use_border, render.use_crop_to_border = True, False
    render.border_min_x, render.border_max_x = left / WIDTH, right / WIDTH
    render.border_min_y, render.border_max_y = 1 - bottom / HEIGHT, 1 - top / HEIGHT
    samples = min(SAMPLES_AROUND, MOST_SAMPLES // ((right - left) * (bottom - top)))
    better = expose(task, scene, max(samples, SAMPLES))
    for row in range(top, bottom):
        start, end = 3 * (WIDTH * row + left), 3 * (WIDTH * row + right)
        colors[start:end] = better[start:end]


def panorama_camera():
    camera = bpy.data.cameras.new("rnmbake panorama")
    camera.type = "PANO"
    owner = camera if hasattr(camera, "panorama_type") else camera.cycles  # <= 4.x
    owner.panorama_type = "EQUIRECTANGULAR"
    return camera


def settle(scene):
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = WIDTH, HEIGHT, 100
    render.film_transparent = render.use_compositing = render.use_sequencer = False
    render.use_file_extension = False
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.image_settings.color_mode = "RGB"
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.film_exposure = 1
    if bpy.app.version < (3, 5):
        cycles.sampling_pattern = "SOBOL"
    cycles.pixel_filter_type = "BOX"  # the mean over the pixel


def as_a_bounce_sees_it(world):
    """A copy without volume, in which Light Path nodes answer as they do to a diffuse bounce."""
    copy = world.copy()
    for node in copy.node_tree.nodes:
        if node.type == "OUTPUT_WORLD":
            for link in list(node.inputs["Volume"].links):
                copy.node_tree.links.remove(link)
    if any(node.type == "LIGHT_PATH" for node in reachable_nodes(tree_surface(copy.node_tree))):
        light_paths.answer(copy.node_tree)
    return copy


def tree_surface(tree):
    source = tree_source(tree, "OUTPUT_WORLD")
    return next(node for node in tree.nodes if node.type == "OUTPUT_WORLD" and any(
        link.from_node == source for link in node.inputs["Surface"].links)).inputs["Surface"]
