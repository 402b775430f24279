"""The decoder of each encoding as a group of shader nodes: layers and a normal map in, E/pi out.

The same formulas as src/encoding/ has, which names their papers. Math nodes divide by 0 to 0 and normalize a vector of
length 0 to itself, so that darkness needs no case of its own.
"""
from math import sqrt

import bpy

from nodes.group_builder import GroupBuilder

S2, S3, S6 = sqrt(1 / 2), sqrt(1 / 3), sqrt(1 / 6)
RNM_BASIS = ((2 * S6, 0, S3), (-S6, S2, S3), (-S6, -S2, S3))
L1_LAYERS = {
    "l0": "a of E/pi = a + v . n, the part that does not depend on the normal",
    "l1x": "x of v, for each colour", "l1y": "y of v, for each colour", "l1z": "z of v, for each colour"}
RNM_LAYERS = {
    "rnm0": "Lightmap for the direction to the right (0.816, 0, 0.577)",
    "rnm1": "Lightmap for the direction to the upper left (-0.408, 0.707, 0.577)",
    "rnm2": "Lightmap for the direction to the lower left (-0.408, -0.707, 0.577)"}
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


def make_flat():
    decoder = Decoder("flat", "The plain lightmap, which no normal map changes",
                      {"flat": "Lightmap for the surface's own normal: the plain layer"})
    return decoder.light(decoder.layers[0])


def rnm_weights(decoder, normal):
    """max(0, n . B_i) of the three directions."""
    dots = [decoder.vector("DOT_PRODUCT", normal, axis, label=f"n . B{i}") for i, axis in enumerate(RNM_BASIS)]
    return [decoder.math("MAXIMUM", dot, 0, label=f"max(0, n . B{i})") for i, dot in enumerate(dots)]


def weighted(decoder, colours, weights):
    """Sum of colour x weight."""
    parts = [decoder.vector("SCALE", colour, weight, label="layer x weight")
             for colour, weight in zip(colours, weights)]
    total = parts[0]
    for part in parts[1:]:
        total = decoder.vector("ADD", total, part)
    return total


def make_rnm_squared(encoding, about):
    decoder = Decoder(encoding, about, RNM_LAYERS)
    squares = [decoder.math("MULTIPLY", weight, weight, label=f"w{i} squared")
               for i, weight in enumerate(rnm_weights(decoder, decoder.normal()))]
    total = decoder.math("ADD", decoder.math("ADD", squares[0], squares[1]), squares[2], label="sum of squares")
    share = decoder.math("DIVIDE", 1, total, label="1 / sum")
    return decoder.light(decoder.vector("SCALE", weighted(decoder, decoder.layers, squares), share, label="E/pi"))


def make_rnm():
    return make_rnm_squared("rnm", "The three maps as baked, by squared weights (Source, corrected)")


def make_rnm_vrad():
    return make_rnm_squared("rnm-vrad", "The three maps scaled to the flat one, by squared weights (Source)")


def make_rnm_bakery():
    decoder = Decoder("rnm-bakery", "The three maps by linear weights that are not renormalised (Bakery)", RNM_LAYERS)
    return decoder.light(weighted(decoder, decoder.layers, rnm_weights(decoder, decoder.normal())))


def make_sh2():
    decoder = Decoder("sh2", "Spherical harmonics of two bands: E/pi = a + v . n", L1_LAYERS)
    x, y, z = decoder.split(decoder.normal(), label="n")
    light = decoder.vector("ADD", decoder.layers[0], weighted(decoder, decoder.layers[1:], (x, y, z)), label="a + v . n")
    return decoder.light(light, may_be_negative=True)


def make_zh3_lobe(name):
    """a + v . n + sqrt5/8 a rho (0.08 + 0.6 rho) (3 (v/|v| . n)^2 - 1), rho = min(sqrt3, sqrt3/2 |v|/a)."""
    group, a, v, normal = lobe_group(name, "ZH3's lobe for one colour (Roughton and others, 2024)")
    above = group.math("MAXIMUM", a, 0, label="a, if above 0")
    ratio = group.math("DIVIDE", group.vector("LENGTH", v, label="|v|"), above, label="|v| / a")
    rho = group.math("MINIMUM", group.math("MULTIPLY", ratio, sqrt(3) / 2), sqrt(3), label="rho")
    strength = group.math("MULTIPLY", rho, group.math("MULTIPLY_ADD", rho, 0.6, 0.08), label="rho (0.08 + 0.6 rho)")
    cosine = group.vector("DOT_PRODUCT", group.vector("NORMALIZE", v), normal, label="v/|v| . n")
    shape = group.math("MULTIPLY_ADD", group.math("MULTIPLY", cosine, cosine), 3, -1, label="3 cos^2 - 1")
    scale = group.math("MULTIPLY", above, sqrt(5) / 8, label="sqrt5/8 a")
    lobe = group.math("MULTIPLY", group.math("MULTIPLY", scale, strength), shape, label="lobe")
    linear = group.math("ADD", a, group.vector("DOT_PRODUCT", v, normal, label="v . n"), label="a + v . n")
    group.output("number", "E/pi", RESULT, group.math("ADD", linear, lobe))
    return group.finish()


def make_geomerics_lobe(name):
    """a A + 2 |v| q^p, q = (1 + v/|v| . n) / 2, r = |v| / 2a, p = 1 + 2r, A = (1 - r) / (1 + r); a where a <= 0."""
    group, a, v, normal = lobe_group(name, "Geomerics' lobe for one colour (Hazel, 2015)")
    length = group.vector("LENGTH", v, label="|v|")
    above = group.math("MAXIMUM", a, 0, label="a, if above 0")
    r = group.math("DIVIDE", length, group.math("MULTIPLY", above, 2), label="r = |v| / 2a")
    ambient = group.math("DIVIDE", group.math("SUBTRACT", 1, r), group.math("ADD", 1, r), label="A = (1 - r) / (1 + r)")
    cosine = group.vector("DOT_PRODUCT", group.vector("NORMALIZE", v), normal, label="v/|v| . n")
    q = group.math("MULTIPLY_ADD", cosine, 0.5, 0.5, label="q, 0 to 1")
    power = group.math("POWER", q, group.math("MULTIPLY_ADD", r, 2, 1, label="p = 1 + 2r"), label="q^p")
    twice = group.math("MULTIPLY", group.math("MULTIPLY", length, 2), group.math("GREATER_THAN", a, 0), label="2 |v|")
    lobe = group.math("MULTIPLY", twice, power, label="lobe")
    group.output("number", "E/pi", RESULT, group.math("ADD", group.math("MULTIPLY", a, ambient, label="a A"), lobe))
    return group.finish()


def lobe_group(name, about):
    group = GroupBuilder(name, about)
    return (group, group.input("number", "a", L1_LAYERS["l0"]), group.input("vector", "v", "v of this colour"),
            group.input("vector", "Normal", "Unit vector in the space of v"))


def make_lobes(encoding, about, lobe):
    """The lobe of each colour, joined."""
    decoder = Decoder(encoding, about, L1_LAYERS)
    normal = decoder.normal()
    layers = [decoder.split(layer, label=name) for layer, name in zip(decoder.layers, L1_LAYERS)]
    colours = [decoder.group(lobe, label=colour, a=a, v=decoder.join(*v, label="v of " + colour), Normal=normal)
               for colour, a, *v in zip(("red", "green", "blue"), *layers)]
    return decoder.light(decoder.join(*colours), may_be_negative=True)


def make_zh3():
    return make_lobes("zh3", "The four layers of zh3, by ZH3's decoder",
                      shared("rnmbake zh3 of a colour", make_zh3_lobe))


def make_geomerics():
    return make_lobes("geomerics", "The four layers of geomerics, by Geomerics' decoder (Bakery's MonoSH shader)",
                      shared("rnmbake geomerics of a colour", make_geomerics_lobe))


DECODERS = {"flat": make_flat, "rnm": make_rnm, "rnm-vrad": make_rnm_vrad, "rnm-bakery": make_rnm_bakery,
            "sh2": make_sh2, "zh3": make_zh3, "geomerics": make_geomerics}
