"""Sums of functions of the normal, weighed by the layers: harmonics, the H-basis, spherical Gaussians (sh.h,
hbasis.h and sg.h of src/encoding/)."""
from math import cos, exp, log, pi, radians, sin, sqrt

from nodes.decoder import Decoder, shared, weighted
from nodes.group_builder import GroupBuilder

SG_TILT, SG_SHARPNESS = radians(65), log(2) / (1 - cos(radians(32.5)))
SG_AXES = ((0, 0, 1), *((sin(SG_TILT) * cos(i * 2 * pi / 5), sin(SG_TILT) * sin(i * 2 * pi / 5), cos(SG_TILT))
                        for i in range(5)))


class Series(Decoder):
    """Decoder of layers NAME0, NAME1, ...; x, y and z are those of the normal."""

    def __init__(self, encoding, about, name, count):
        super().__init__(encoding, about, {f"{name}{i}": f"Coefficient {i}" for i in range(count)})
        self.x, self.y, self.z = self.split(self.normal(), label="n")

    def times(self, a, b, label):
        return self.math("MULTIPLY", a, b, label=label)

    def product(self, scale, a, b, label):
        return self.times(scale, self.times(a, b, label), f"{scale:.4g} {label}")

    def difference_of_squares(self, scale):
        squares = self.times(self.x, self.x, "x squared"), self.times(self.y, self.y, "y squared")
        return self.times(self.math("SUBTRACT", *squares), scale, f"{scale:.4g} (x squared - y squared)")

    def sum(self, values):
        return self.light(weighted(self, self.layers, values), may_be_negative=True)


def make_sh3():
    """The clamped cosine over pi weighs the bands by 1, 2/3 and 1/4."""
    decoder = Series("sh3", "Spherical harmonics of three bands: nine coefficients of the light that arrives", "sh", 9)
    x, y, z = decoder.x, decoder.y, decoder.z
    band0, band1, band2, zonal = 0.28209479, 0.48860251 * 2 / 3, 1.09254843 / 4, 0.31539157 / 4
    linear = [decoder.times(band1, axis, f"{band1:.4g} {name}") for axis, name in ((y, "y"), (z, "z"), (x, "x"))]
    z_squared = decoder.times(z, z, "z squared")
    return decoder.sum([
        band0, *linear, decoder.product(band2, x, y, "x y"), decoder.product(band2, y, z, "y z"),
        decoder.math("MULTIPLY_ADD", z_squared, 3 * zonal, -zonal, label=f"{zonal:.4g} (3 z squared - 1)"),
        decoder.product(band2, x, z, "x z"), decoder.difference_of_squares(band2 / 2)])


def h_values(decoder):
    """h0 to h3."""
    linear = sqrt(3 / (2 * pi))
    return [sqrt(1 / (2 * pi)), decoder.times(linear, decoder.y, f"{linear:.4g} y"),
            decoder.math("MULTIPLY_ADD", decoder.z, 2 * linear, -linear, label=f"{linear:.4g} (2 z - 1)"),
            decoder.times(linear, decoder.x, f"{linear:.4g} x")]


def make_h4():
    decoder = Series("h4", "H-basis of four functions (Habel and Wimmer, 2010)", "h", 4)
    return decoder.sum(h_values(decoder))


def make_h6():
    decoder = Series("h6", "H-basis of six functions (Habel and Wimmer, 2010)", "h", 6)
    square = sqrt(15 / (2 * pi))
    return decoder.sum([*h_values(decoder), decoder.product(square, decoder.x, decoder.y, "x y"),
                        decoder.difference_of_squares(square / 2)])


def make_sg_lobe(name):
    """Hill's fit of a lobe's E/pi by the cosine to its axis, for lobes of SG_SHARPNESS."""
    knee, tail = 0.36, exp(-SG_SHARPNESS)
    scale, bias = 1 + 2 * tail ** 2 - 1 / SG_SHARPNESS, (tail - tail ** 2) / SG_SHARPNESS - tail ** 2
    width, whole = sqrt(1 - scale), 2 * (1 - tail ** 2) / SG_SHARPNESS
    offset = width / (4 * knee)
    group = GroupBuilder(name, "E/pi of a spherical Gaussian of radiance 1 (Hill's fit, in Pettineo, 2016)")
    cosine = group.input("number", "cosine", "Of the normal to the lobe's axis")
    slope = group.math("MULTIPLY", cosine, knee)
    shifted = group.math("ADD", slope, offset)
    near = group.math("DIVIDE", group.math("MULTIPLY", shifted, shifted), width, label="around the horizon")
    far = group.math("MAXIMUM", cosine, 0, label="elsewhere")
    is_far = group.math("GREATER_THAN", group.math("ABSOLUTE", slope), offset, label="1 elsewhere")
    bent = group.math("MULTIPLY_ADD", group.math("SUBTRACT", far, near), is_far, near, label="the one that holds")
    group.output("number", "E/pi", "Light of the lobe", group.math("MULTIPLY_ADD", bent, scale * whole, bias * whole))
    return group.finish()


def make_sg():
    decoder = Decoder("sg", "Six spherical Gaussians over the upper hemisphere",
                      {f"sg{i}": f"Radiance of lobe {i}" for i in range(len(SG_AXES))})
    lobe, normal = shared("rnmbake sg of a lobe", make_sg_lobe), decoder.normal()
    cosines = [decoder.vector("DOT_PRODUCT", normal, axis, label=f"n . axis {i}") for i, axis in enumerate(SG_AXES)]
    values = [decoder.group(lobe, label=f"lobe {i}", cosine=cosine) for i, cosine in enumerate(cosines)]
    return decoder.light(weighted(decoder, decoder.layers, values), may_be_negative=True)
