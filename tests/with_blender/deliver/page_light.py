"""What a delivery's pages say, beside the lightmaps that they were made from."""
import json
import math
from pathlib import Path

from pictures import read_picture

BASES = {"rnm0": (math.sqrt(2 / 3), 0, 1 / math.sqrt(3)),
         "rnm1": (-1 / math.sqrt(6), 1 / math.sqrt(2), 1 / math.sqrt(3)),
         "rnm2": (-1 / math.sqrt(6), -1 / math.sqrt(2), 1 / math.sqrt(3))}


def colour(pixel, layer=""):
    return [pixel[(layer and layer + ".") + channel] for channel in "RGB"]


class Texel:
    """A covered texel: where it lies on a page, and E/pi that was baked for some normals of Blender's world."""

    def __init__(self, page, x, y, pixel):
        self.page, self.x, self.y = page, x, y
        normal = [pixel["normal." + axis] for axis in "XYZ"]
        tangent = [pixel["tangent." + axis] for axis in "XYZ"]
        cross = [normal[1] * tangent[2] - normal[2] * tangent[1], normal[2] * tangent[0] - normal[0] * tangent[2],
                 normal[0] * tangent[1] - normal[1] * tangent[0]]
        frame = tangent, [pixel["tangent.S"] * part for part in cross], normal
        self.baked = {"flat": (normal, colour(pixel))}
        for name, basis in BASES.items():
            world = [sum(b * vector[axis] for b, vector in zip(basis, frame)) for axis in range(3)]
            self.baked[name] = world, colour(pixel, name)

    def fits(self, ranged, mean=False):
        """Whether a + v . n that returns all four bakes has |v_i| <= `ranged` a along the world's axes, in every colour or in
        their mean."""
        colours = [[sum(light) / 3] if mean else light for _, light in self.baked.values()]
        return all(self._fits(ranged, *bakes) for bakes in zip(*colours))

    def _fits(self, ranged, flat, *tilted):
        up = (sum(tilted) - 3 * flat) / (math.sqrt(3) - 3)
        a = flat - up
        normals = [normal for normal, _ in self.baked.values()]
        # The basis is orthonormal: v is the sum of its parts along it.
        parts = [light - a for light in tilted]
        v = [sum(part * normal[axis] for part, normal in zip(parts, normals[1:])) for axis in range(3)]
        return a > 0 and max(map(abs, v)) <= .99 * ranged * a


def covered_texels(delivery, lightmaps):
    """Of every object, by the record's page, scale and offset."""
    record = json.loads((Path(delivery) / "lightmaps.json").read_text())
    manifest = json.loads((Path(lightmaps) / "manifest.json").read_text())
    files = {one["key"]: one["files"][0] for one in manifest["objects"]}
    texels = []
    for placed in record["objects"]:
        width, height, rows = read_picture(Path(lightmaps) / files[placed["key"]])
        page = record["pages"][placed["page"]]
        left, top = (round(placed["offset"][axis] * page[size]) for axis, size in ((0, "width"), (1, "height")))
        assert abs(placed["scale"][0] * page["width"] - width) < 1e-6 and abs(placed["scale"][1] * page["height"] - height) < 1e-6
        texels += [Texel(placed["page"], left + x, top + y, rows[y][x]) for y in range(height) for x in range(width)
                   if rows[y][x]["coverage"] > .5 and rows[y][x]["normal.X"] ** 2 + rows[y][x]["normal.Y"] ** 2
                   + rows[y][x]["normal.Z"] ** 2 > .5]
    return texels
