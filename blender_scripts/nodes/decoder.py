"""What the decoders share: layers and a normal map in, E/pi out."""
import bpy

from nodes.group_builder import GroupBuilder

NORMAL_MAP = "Tangent-space normal map: an Image Texture with the colour space Non-Color"
FLIP_GREEN = "1 where green points up in one of normal map and lightmap and down in the other, else 0"
RESULT = "Light that arrives, E/pi: multiply it by the albedo"


def shared(name, make):
    """A group that others use, made once."""
    return bpy.data.node_groups.get(name) or make(name)


def make_normal(name):
    group = GroupBuilder(name, "A normal map's colour as a unit vector in tangent space, 2t - 1")
    colour = group.input("colour", "Normal Map", NORMAL_MAP, (0.5, 0.5, 1, 1))
    flip = group.input("number", "Flip Green", FLIP_GREEN, 0, is_share=True)
    signs = group.join(1, group.math("MULTIPLY_ADD", flip, -2, 1, label="1 or -1"), 1, label="sign of y")
    vector = group.vector("MULTIPLY_ADD", colour, (2, 2, 2), (-1, -1, -1), label="2t - 1")
    turned = group.vector("MULTIPLY", vector, signs, label="green switch")
    group.output("vector", "Normal", "Unit vector: x right, y up, z off the surface", group.vector("NORMALIZE", turned))
    return group.finish()


class Decoder(GroupBuilder):
    """A group whose inputs are the layers, the normal map and its green switch."""

    def __init__(self, encoding, about, layers):
        super().__init__("rnmbake " + encoding, about)
        self.layers = [self.input("colour", name, tip, (0, 0, 0, 1)) for name, tip in layers.items()]
        self.normal_map = self.input("colour", "Normal Map", NORMAL_MAP, (0.5, 0.5, 1, 1))
        self.flip = self.input("number", "Flip Green", FLIP_GREEN, 0, is_share=True)

    def normal(self):
        return self.group(shared("rnmbake normal", make_normal), Normal_Map=self.normal_map, Flip_Green=self.flip)

    def light(self, value, may_be_negative=False):
        tip = RESULT + ("; below 0 where the lobe is, which other renderers clamp" if may_be_negative else "")
        self.output("colour", "E/pi", tip, value)
        return self.finish()


def weighted(decoder, colours, weights):
    """Sum of colour x weight."""
    parts = [decoder.vector("SCALE", colour, weight, label="layer x weight")
             for colour, weight in zip(colours, weights)]
    total = parts[0]
    for part in parts[1:]:
        total = decoder.vector("ADD", total, part)
    return total
