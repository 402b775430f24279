"""The layers a and v: linear, and as the lobes of ZH3 and Geomerics (sh2.h, zh3.h and geomerics.h of src/encoding/).

Math nodes divide by 0 to 0 and normalize a vector of length 0 to itself, so that darkness needs no case of its own.
"""
from math import sqrt

from nodes.decoder import RESULT, Decoder, shared, weighted
from nodes.group_builder import GroupBuilder

L1_LAYERS = {
    "l0": "a of E/pi = a + v . n, the part that does not depend on the normal",
    "l1x": "x of v, for each colour", "l1y": "y of v, for each colour", "l1z": "z of v, for each colour"}


def make_sh2():
    decoder = Decoder("sh2", "Spherical harmonics of two bands: E/pi = a + v . n", L1_LAYERS)
    x, y, z = decoder.split(decoder.normal(), label="n")
    along = weighted(decoder, decoder.layers[1:], (x, y, z))
    return decoder.light(decoder.vector("ADD", decoder.layers[0], along, label="a + v . n"), may_be_negative=True)


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
