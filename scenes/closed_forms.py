"""Scenes whose right answer is a formula. Values are E/pi, what a white surface would send back.

plane_sun   max(0, D . b) x strength / pi for every basis vector b, D the sun's direction; 0 below the plane
plane_sky   (1 + b.z) / 2
plane_lamp  a square lamp of radiance 1, one metre above; half size 1: flat E 1.74083950,
            RNM 1.02119225, 1.02492043, 1.02492043; half size 0.5: flat E 0.75227469, RNM 0.43432599 three times
furnace     emission / (1 - albedo) x (1 + b.z) / 2
"""

import math

import kit


def plane(half, albedo=0.5):
    """A square that faces up, u along +x, v along +y in both UV layers, the whole lightmap filled."""
    builder = kit.Builder(tile=2 * half, margin=0.0)
    builder.quad((-half, -half, 0), (2 * half, 0, 0), (0, 2 * half, 0))
    return builder.object("plane", [kit.diffuse("plane", (albedo,) * 3)])


def plane_sun(angle=54.7, azimuth=0.0, strength=math.pi):
    kit.start()
    plane(1.0)
    kit.sun(kit.direction(angle, azimuth), strength)
    kit.world()
    kit.camera((0, -5, 4), (0, 0, 0))


def plane_sky(strength=1.0):
    kit.start()
    plane(1.0)
    kit.world((1, 1, 1), strength)
    kit.camera((0, -5, 4), (0, 0, 0))


def plane_lamp(half=1.0):
    """The plane measures 2 mm, so that every texel sees the lamp from the place that the formula is for."""
    kit.start()
    plane(0.001)
    lamp = kit.Builder()
    lamp.quad((-half, half, 1), (2 * half, 0, 0), (0, -2 * half, 0))  # faces down
    lamp.object("lamp", [kit.emitter("lamp", (1, 1, 1))])
    kit.world()
    kit.camera((0, -0.005, 0.004), (0, 0, 0))


def furnace(albedo=0.5, emission=1.0):
    kit.start()
    builder = kit.Builder(tile=2.0)
    builder.box((-1, -1, -1), (1, 1, 1), inward=True)
    builder.object("furnace", [kit.diffuse("furnace", (albedo,) * 3, (emission,) * 3)])
    kit.world()
    kit.camera((0, -0.9, 0), (0, 0, 0))
