"""A crate and a smooth figure before a brick wall, on cobbles: edges of depth, and reliefs whose heights are known.

`floor`, `wall` and `crate` are flat faces with the normal maps of patterns.RELIEFS; `figure` has none, so that nothing on it
lies in a shadow of its own relief.
"""

import math

import kit
import panels
import patterns

TILE = 1.6  # metres of a pattern's side


def _figure(name, x, y, material):
    """A pawn, a person's height."""
    builder = kit.Builder(margin=0.02)
    profile = [(0.32, 0.0), (0.34, 0.06), (0.3, 0.14), (0.2, 0.3), (0.15, 0.6), (0.13, 0.9), (0.15, 1.05), (0.24, 1.12),
               (0.24, 1.16), (0.14, 1.22)]
    head = [(0.22 * math.cos(a), 1.42 + 0.22 * math.sin(a)) for a in (math.pi * (i / 11.8 - 0.35) for i in range(11))]
    builder.lathe([*profile, *head, (0.0004, 1.64)], 48, (x, y, 0))
    builder.object(name, [material])


def build():
    kit.start()
    floor, wall, crate = (panels.mapped(f"{name}_relief", patterns.RELIEFS[name](), roughness=0.8)
                          for name in ("floor", "wall", "crate"))
    for name, material, corner, along_u, along_v in (
            ("floor", floor, (-6.4, -6.4, 0), (12.8, 0, 0), (0, 8, 0)),
            ("wall", wall, (-6.4, 1.6, 0), (12.8, 0, 0), (0, 0, 4.8))):
        builder = kit.Builder(tile=TILE, margin=0.008)
        builder.quad(corner, along_u, along_v, cells=(4, 4))
        builder.object(name, [material])
    builder = kit.Builder(tile=TILE, margin=0.015)
    builder.box((-1.5, -0.9, 0), (-0.4, 0.2, 1.1), turn=20, skip="z")
    builder.object("crate", [crate])
    _figure("figure", 0.65, -0.55, kit.diffuse("figure", (0.7, 0.6, 0.5)))
    kit.sun((-0.5, -0.6, 0.62), 5.0)
    kit.world((0.4, 0.5, 0.7), 0.3)
    kit.camera((0.1, -3.6, 3.1), (-0.1, 0.0, 0.55), lens=32)
