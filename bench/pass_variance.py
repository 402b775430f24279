"""Whether a bake in passes is as quiet as one in one piece: variance over seeds.

    python3 bench/pass_variance.py BINARY SCENE.blend BLENDER...

Prints a row of docs/passes.md for each Blender (a program, or a Python that has bpy). Each seed bakes all samples at once, and
again in steps, each of which adds to the one before.
"""
import json
from pathlib import Path
import statistics
import subprocess
import sys
import tempfile

from lightmaps import MAPS, covered_texels

SEEDS, STEPS = 12, (32, 64, 128, 256)
CHANNELS = tuple(layer + color for layer in MAPS for color in "RGB")


def bake(binary, scene, blender, out, cache, samples, seed):
    subprocess.run([binary, "bake", scene, "-o", out, "--cache", cache, "--blender", blender, "--samples", str(samples), "--seed",
                    str(seed), "--resolution", "16", "--bounces", "4", "--depth", "float", "--stderr", "never", "--dilate", "0",
                    "--save-scene", "never", "-q"], check=True)


def values(out):
    """Of all covered texels and directions, in one order."""
    found = []
    manifest = json.loads((out / "manifest.json").read_text(encoding="utf-8"))
    for entry in sorted(manifest["objects"], key=lambda one: one["key"]):
        found += [texel[name] for texel in covered_texels(out / entry["files"][0]) for name in CHANNELS]
    return found


def variance(bakes):
    return statistics.fmean(statistics.variance(one) for one in zip(*bakes))


def row(binary, scene, blender, folder):
    whole, steps = [], []
    for seed in range(SEEDS):
        bake(binary, scene, blender, folder / "whole", "none", STEPS[-1], 100 * seed)
        whole.append(values(folder / "whole"))
        for samples in STEPS:
            bake(binary, scene, blender, folder / "steps", folder / "cache", samples, 100 * seed)
        steps.append(values(folder / "steps"))
    means = [statistics.fmean(map(statistics.fmean, bakes)) for bakes in (whole, steps)]
    # Each seed left out in turn: how far the ratio may be off.
    without = [variance(steps[:i] + steps[i + 1:]) / variance(whole[:i] + whole[i + 1:]) for i in range(SEEDS)]
    error = ((SEEDS - 1) * statistics.pvariance(without)) ** .5
    manifest = json.loads((folder / "whole/manifest.json").read_text(encoding="utf-8"))
    version = manifest["blender"]
    return (f"| {version} | {variance(whole):.3g} | {variance(steps):.3g} | {variance(steps) / variance(whole):.3f} +- {error:.3f} | "
            f"{100 * (means[1] / means[0] - 1):+.3f} % |")


def main(binary, scene, *blenders):
    print("| Blender | variance in one piece | in four steps | ratio | difference of the means |")
    print("|---|---|---|---|---|")
    for blender in blenders:
        with tempfile.TemporaryDirectory(prefix="rnmbake-variance-") as folder:
            print(row(Path(binary).resolve(), Path(scene), blender, Path(folder)), flush=True)


main(*sys.argv[1:])
