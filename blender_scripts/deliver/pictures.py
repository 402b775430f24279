"""Colours of pictures as Cycles shows them, where an engine would show others."""
import bpy
import numpy as np

from deliver.links import hand_over

MADE = {}  # pictures made of others, each of which many materials may show


def stored(image):
    """[pixels, channels]"""
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(-1, image.channels)


def is_dimmed(node):
    """Whether a picture has an alpha channel that nothing asks for: Cycles then shows its colours, as they are stored, times alpha."""
    image = node.image
    return (image is not None and not image.is_float and image.size[0] > 0 and image.channels == 4 and image.alpha_mode == "STRAIGHT"
            and not node.outputs["Alpha"].is_linked)


def shown(node):
    """[pixels, 3] of a node's picture, coded as it is stored."""
    pixels = stored(node.image)
    return pixels[:, :3] * pixels[:, 3:] if is_dimmed(node) else pixels[:, :3]


def new_image(like, name, pixels, is_data):
    """[pixels, 3]"""
    image = bpy.data.images.new(name, *like.size, alpha=False, is_data=is_data)
    image.pixels.foreach_set(np.column_stack([pixels, np.ones(len(pixels))]).astype(np.float32).ravel())
    return image


def put_in_place(tree, node, socket, how, make_pixels, is_data):
    """A picture made of the node's takes its place for a socket. `how` it is made is the end of its name; make_pixels(): [pixels, 3],
    asked for once for each picture and way."""
    key = node.image, how, is_dimmed(node)
    if key not in MADE:
        MADE[key] = new_image(node.image, f"{node.image.name} {how}", make_pixels(), is_data)
    own = tree.nodes.new("ShaderNodeTexImage")
    own.image, own.interpolation, own.extension = MADE[key], node.interpolation, node.extension
    hand_over(tree, node.inputs["Vector"], own.inputs["Vector"])
    tree.links.new(own.outputs["Color"], socket)


def settle_color(tree, socket):
    node = socket.links[0].from_node if socket.is_linked else None
    if node is None or node.type != "TEX_IMAGE" or not is_dimmed(node) or np.all(stored(node.image)[:, 3] == 1):
        return
    put_in_place(tree, node, socket, "times alpha", lambda: shown(node), node.image.colorspace_settings.is_data)
