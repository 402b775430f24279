"""Where a material lets through what is behind it, as glTF says it: alpha, which cuts out or blends."""
import bpy
import numpy as np

from deliver import pictures
from deliver.links import hand_over, source

LUMINANCE = (0.2126, 0.7152, 0.0722)  # of linear Rec. 709, by which Cycles takes a colour for a number


def take(tree, mix, alpha):
    """The factor, or 1 less it where the Transparent BSDF comes second."""
    if source(mix.inputs[1]).type != "BSDF_TRANSPARENT":
        inverse = tree.nodes.new("ShaderNodeMath")
        inverse.operation, inverse.inputs[0].default_value = "SUBTRACT", 1
        tree.links.new(inverse.outputs[0], alpha)
        alpha = inverse.inputs[1]
    hand_over(tree, mix.inputs[0], alpha)


def show_through(material, principled):
    """Cycles asks the opacity alone; the exporter asks for the way of blending that Eevee has, from 4.2 on for a node that
    rounds. Cutting out needs no order, so a picture does that where it can."""
    alpha = principled.inputs["Alpha"]
    if is_color(alpha):
        make_number(material.node_tree, alpha)
    if not alpha.is_linked:
        if alpha.default_value < 1:
            set_blending(material, "BLEND")
    elif not is_mask(alpha.links[0]):
        set_blending(material, "BLEND")
    elif bpy.app.version < (4, 2):
        set_blending(material, "CLIP")
    else:
        tree = material.node_tree
        cut = tree.nodes.new("ShaderNodeMath")
        cut.operation = "ROUND"
        tree.links.new(alpha.links[0].from_socket, cut.inputs[0])
        tree.links.new(cut.outputs[0], alpha)


def set_blending(material, method):
    if bpy.app.version < (4, 2) and material.blend_method == "OPAQUE":
        material.blend_method, material.alpha_threshold = method, 0.5


def is_mask(link):
    """Whether a picture's opacity is 0 or 1 nearly everywhere."""
    node = link.from_node
    if node.type != "TEX_IMAGE" or node.image is None or not node.image.size[0]:
        return False
    opacity = pictures.stored(node.image)[:, -1 if link.from_socket.name == "Alpha" else 0]
    return np.mean((opacity > 0.1) & (opacity < 0.9)) < 0.2


def is_color(alpha):
    """Whether a picture's colour is taken for a number, as Cycles does: its luminance. The exporter would take what is stored of
    its red."""
    if not alpha.is_linked or alpha.links[0].from_socket.name != "Color":
        return False
    image = alpha.links[0].from_node.image if alpha.links[0].from_node.type == "TEX_IMAGE" else None
    return image is not None and not image.is_float and not image.colorspace_settings.is_data and image.channels >= 3


def make_number(tree, alpha):
    """A picture of that number takes the place of the colour."""
    node = alpha.links[0].from_node
    pictures.put_in_place(tree, node, alpha, "as opacity", lambda: luminance(pictures.shown(node)), is_data=True)


def luminance(color):
    """[pixels, 3], all three the same, of sRGB."""
    number = np.where(color <= 0.04045, color / 12.92, ((color + 0.055) / 1.055) ** 2.4) @ LUMINANCE
    return np.repeat(number[:, None], 3, axis=1)
