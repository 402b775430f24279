"""Bakes a tiny scene again and again, each time with one setting of the file changed, and says which change a texel.

    blender -b --factory-startup --python state_sweep.py -- REPORT.json [all] [bare]

Run by hand, against a new Blender: docs/scene-state.md. `all`: settings of world, lights, objects and materials, too,
which are the scene's own content. `bare`: as Blender's own bake takes them, nothing put back: what could leak.
"""
import json
import os
import sys
from array import array

import bpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from state_cases import build, extremes, owners, properties  # noqa: E402
from bake import receivers  # noqa: E402
from scene_ops import cycles, neutral  # noqa: E402

SIDE = 8
TILTED = [0.8164966, 0, 0.5773503]  # the first basis vector
SETTINGS = {"samples": 4, "bounces": 6, "seed": 0, "clamp": 0, "device": "CPU"}


class Bench:
    """Bakes one receiver over the floor, as the driver's bakes do."""

    def __init__(self, scene, bare):
        self.scene, self.bare = scene, bare

    def bake(self):
        self.settle()
        image = cycles.new_float_image("baked", SIDE, SIDE)
        mesh = bpy.data.meshes.new("receiver")
        mesh.from_pydata([(-2, -2, 1e-5), (2, -2, 1e-5), (2, 2, 1e-5), (-2, 2, 1e-5)], [], [range(4)])
        receivers._set_normals(mesh, array("f", 4 * TILTED))
        mesh.polygons.foreach_set("use_smooth", [True])
        mesh.uv_layers.new().data.foreach_set("uv", [0, 0, 1, 0, 1, 1, 0, 1])
        receiver = receivers.make_receiver(self.scene, mesh, receivers.make_material(image))
        cycles.bake_diffuse(self.scene, receiver)
        pixels = tuple(image.pixels)
        bpy.data.materials.remove(receiver.data.materials[0])
        bpy.data.meshes.remove(mesh)
        bpy.data.images.remove(image)
        return pixels

    def settle(self):
        if self.bare:
            settings = self.scene.cycles
            settings.samples, settings.max_bounces = SETTINGS["samples"], SETTINGS["bounces"]
            settings.use_denoising = False
        else:
            neutral.neutralise(self.scene)
            cycles.apply_settings(self.scene, SETTINGS)


def contents(scene):
    found = {"world": scene.world, "world.cycles": scene.world.cycles}
    for light in bpy.data.lights:
        found.update({f"light {light.name}": light, f"light.cycles {light.name}": light.cycles})
    for ob in list(scene.objects):
        found.update({f"object {ob.name}": ob, f"object.cycles {ob.name}": ob.cycles})
    for material in bpy.data.materials:
        found.update({f"material {material.name}": material, f"material.cycles {material.name}": material.cycles})
    return found


def sweep(bench, name, owner, leaks):
    """Adds to `leaks`: the extremes of a setting that change a texel, and the sum of all texels over what it was."""
    clean = bench.bake()
    for prop in properties(name, owner):
        for value in extremes(owner, prop):
            before = getattr(owner, prop.identifier)
            try:
                setattr(owner, prop.identifier, value)
                pixels = bench.bake()
                setattr(owner, prop.identifier, before)
            except (TypeError, AttributeError):  # a choice that this build does not have
                continue
            if pixels != clean:
                leaks.setdefault(f"{name}.{prop.identifier}", {})[str(value)] = sum(pixels) / sum(clean)
                print("LEAK", name, prop.identifier, value, flush=True)
    if bench.bake() != clean:
        raise RuntimeError(f"{name}: its settings were not restored")


def main(report_file, *modes):
    scene = build()
    bench, leaks = Bench(scene, "bare" in modes), {}
    for name, owner in {**owners(scene), **(contents(scene) if "all" in modes else {})}.items():
        sweep(bench, name, owner, leaks)
    with open(report_file, "w", encoding="utf-8") as stream:
        json.dump({"blender": bpy.app.version_string, "leaks": leaks}, stream, indent=1)


main(*sys.argv[sys.argv.index("--") + 1:])
