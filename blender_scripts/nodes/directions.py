"""One direction for each texel: ambient and highlight, and Unity's dominant direction (ahd.h and unity_dominant.h of
src/encoding/)."""
from nodes.decoder import Decoder

LEAST_DIRECTIONALITY = 1e-4


def make_ahd():
    """ambient + directional max(0, direction . n)."""
    decoder = Decoder("ahd", "Ambient light, and a highlight from one direction (Iwanicki, 2013)", {
        "ambient": "Colour of the light that does not depend on the normal",
        "directional": "Colour of the highlight",
        "direction": "Unit vector to the highlight, as it is: the layer's numbers may be negative"})
    ambient, directional, direction = decoder.layers
    cosine = decoder.vector("DOT_PRODUCT", direction, decoder.normal(), label="direction . n")
    weight = decoder.math("MAXIMUM", cosine, 0, label="max(0, direction . n)")
    highlight = decoder.vector("SCALE", directional, weight, label="highlight")
    return decoder.light(decoder.vector("ADD", ambient, highlight, label="E/pi"))


def make_dominant():
    """colour (n . (direction - 1/2) + 1/2) / max(1e-4, directionality)."""
    decoder = Decoder("dominant", "Colour and dominant direction, as Unity's built-in shaders decode them", {
        "colour": "The plain lightmap",
        "direction": "d/2 + 1/2, as Unity stores it",
        "directionality": "w: what the decode returns for the surface's own normal"})
    colour, direction, directionality = decoder.layers
    centred = decoder.vector("SUBTRACT", direction, (0.5, 0.5, 0.5), label="direction - 1/2")
    cosine = decoder.vector("DOT_PRODUCT", decoder.normal(), centred, label="n . (direction - 1/2)")
    half_lambert = decoder.math("ADD", cosine, 0.5, label="half Lambert")
    w = decoder.math("MAXIMUM", decoder.split(directionality)[0], LEAST_DIRECTIONALITY, label="w, above 0")
    share = decoder.math("DIVIDE", half_lambert, w, label="half Lambert / w")
    return decoder.light(decoder.vector("SCALE", colour, share, label="E/pi"), may_be_negative=True)
