"""The box that every light transport paper owns, in dimensions of our own: 3.2 x 2.4 x 2 m, one lamp."""

import math

import kit

WIDTH, DEPTH, HEIGHT = 3.2, 2.4, 2.0


def _one_quad(name, material, corner, along_u, along_v):
    builder = kit.Builder(margin=0.0)
    builder.quad(corner, along_u, along_v)
    builder.object(name, [material])


def _walls():
    x, y, z = WIDTH / 2, DEPTH, HEIGHT
    white = kit.diffuse("white", (0.76, 0.74, 0.7))
    coral = kit.diffuse("coral", (0.75, 0.11, 0.06))
    teal = kit.diffuse("teal", (0.04, 0.33, 0.36))
    _one_quad("floor", white, (-x, 0, 0), (2 * x, 0, 0), (0, y, 0))
    _one_quad("ceiling", white, (-x, y, z), (2 * x, 0, 0), (0, -y, 0))
    _one_quad("back", white, (-x, y, 0), (2 * x, 0, 0), (0, 0, z))
    _one_quad("left", coral, (-x, 0, 0), (0, y, 0), (0, 0, z))
    _one_quad("right", teal, (x, y, 0), (0, -y, 0), (0, 0, z))


def _props():
    sand = kit.diffuse("sand", (0.74, 0.66, 0.5))
    tall = kit.Builder()
    tall.box((-1.0, 1.35, 0), (-0.4, 1.95, 1.2), turn=20)
    tall.object("tall", [sand])
    short = kit.Builder()
    short.box((0.25, 0.75, 0), (0.9, 1.4, 0.55), turn=-17)
    short.object("short", [kit.diffuse("chalk", (0.78, 0.78, 0.78))])
    ball = kit.Builder(margin=0.02)
    turns = [math.pi * (i + 0.02) / 24.04 for i in range(25)]
    ball.lathe([(0.27 * math.sin(a), 0.27 - 0.27 * math.cos(a)) for a in turns], 48, (0.57, 1.08, 0.55))
    ball.object("ball", [kit.diffuse("honey", (0.8, 0.5, 0.12))])


def build(radiance=14.0):
    kit.start(exposure=0.55, look="Medium High Contrast")
    _walls()
    _props()
    lamp = kit.Builder(margin=0.0)
    lamp.quad((-0.4, 1.45, HEIGHT - 0.005), (0.8, 0, 0), (0, -0.5, 0))
    lamp.object("lamp", [kit.emitter("lamp", (1.0, 0.87, 0.68), radiance)])
    kit.world()
    kit.camera((0, -3.15, 1.0), (0, 1, 0.99), lens=37)
