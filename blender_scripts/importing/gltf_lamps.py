"""Lamps as KHR_lights_punctual has them: points without a size, in candela and lux."""
import math

import bpy

from core.gltf_extensions import listed
from core.gltf_lights import LUMENS_PER_WATT
from core.gltf_prepare import TAG


def put_right(gltf):
    """Returns what the user should be warned of."""
    spots = []
    for lamp in bpy.data.lights:
        if TAG in lamp:
            set_lamp(lamp, gltf.lights()[lamp[TAG]])
            del lamp[TAG]
            spots += [f"{lamp.name!r}"] if lamp.type == "SPOT" else []
    if spots and bpy.app.version < (3, 5):
        return [f"spots{listed(spots)} fade by the cosine towards their edge, as in all Blenders before 3.5; bake with "
                "a newer one"]
    return []


def set_lamp(lamp, light):
    lamp.color = light["color"]
    if lamp.type == "SUN":
        lamp.angle = 0
        lamp.energy = light["intensity"] / LUMENS_PER_WATT  # W/m2 on a surface that faces it
    else:
        lamp.shadow_soft_size = 0
        lamp.energy = 4 * math.pi * light["intensity"] / LUMENS_PER_WATT  # W, were it to shine alike to all sides
    if lamp.type == "SPOT":
        inner, outer = light["spot"]["innerConeAngle"], light["spot"]["outerConeAngle"]
        lamp.spot_size = 2 * outer
        lamp.spot_blend = blend(inner, outer)


def blend(inner, outer):
    """Cycles' falloff takes this share of the way from the cone's edge to its axis, counted in cosines."""
    edge = 1 - math.cos(outer)
    return min(max((math.cos(inner) - math.cos(outer)) / edge, 0.0), 1.0) if edge > 0 else 0.0
