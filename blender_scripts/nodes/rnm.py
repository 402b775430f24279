"""The plain lightmap, and the three maps of the Half-Life 2 basis (src/encoding/rnm.h)."""
from math import sqrt

from nodes.decoder import Decoder, weighted

S2, S3, S6 = sqrt(1 / 2), sqrt(1 / 3), sqrt(1 / 6)
RNM_BASIS = ((2 * S6, 0, S3), (-S6, S2, S3), (-S6, -S2, S3))
RNM_LAYERS = {
    "rnm0": "Lightmap for the direction to the right (0.816, 0, 0.577)",
    "rnm1": "Lightmap for the direction to the upper left (-0.408, 0.707, 0.577)",
    "rnm2": "Lightmap for the direction to the lower left (-0.408, -0.707, 0.577)"}


def make_flat():
    decoder = Decoder("flat", "The plain lightmap, which no normal map changes",
                      {"flat": "Lightmap for the surface's own normal: the plain layer"})
    return decoder.light(decoder.layers[0])


def rnm_weights(decoder, normal):
    """max(0, n . B_i) of the three directions."""
    dots = [decoder.vector("DOT_PRODUCT", normal, axis, label=f"n . B{i}") for i, axis in enumerate(RNM_BASIS)]
    return [decoder.math("MAXIMUM", dot, 0, label=f"max(0, n . B{i})") for i, dot in enumerate(dots)]


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


def make_rnm_linear(encoding, about, may_be_negative):
    decoder = Decoder(encoding, about, RNM_LAYERS)
    return decoder.light(weighted(decoder, decoder.layers, rnm_weights(decoder, decoder.normal())), may_be_negative)


def make_rnm_signed():
    return make_rnm_linear("rnm-signed", "Projections on the three directions, by linear weights (BakingLab)", True)


def make_rnm_bakery():
    return make_rnm_linear("rnm-bakery", "The three maps as baked, by linear weights, not renormalised (Bakery)", False)
