"""Standard errors of bakes against the truth, and --noise beside a fixed number of samples.

    python3 bench/pass_errors.py BINARY NOISE RESOLUTION SCENE.blend...

Prints a row of docs/passes.md for each scene. The truth is the reference of the same materials (--materials lambert), traced to a
third of the noise; its own standard errors count.
"""
import json
import math
from pathlib import Path
import sys
import tempfile

import measure
from lightmaps import MAPS, covered_texels


def run(*words):
    """Processor seconds, of Blender, too."""
    return measure.run(words)["cpu"]


def manifest(folder):
    return json.loads((folder / "manifest.json").read_text(encoding="utf-8"))["objects"]


def within(baked, truth):
    """Values, those of them within two standard errors of the truth, and the mean difference in percent of the mean."""
    count = held = 0
    difference = total = 0.0
    for a, b in zip(covered_texels(baked), covered_texels(truth)):
        for layer in MAPS:
            error = (layer[:-1] or "flat") + "_stderr."
            for color in "RGB":
                d = a[layer + color] - b[layer + color]
                sigma = math.hypot(a[error + color], b[error + color])
                count += 1
                held += abs(d) <= 2 * sigma
                difference += d
                total += b[layer + color]
    return count, held, difference, total


def row(binary, noise, resolution, scene, folder):
    common = ["--resolution", resolution, "--depth", "float", "--dilate", 0, "--save-scene", "never"]
    bake = [binary, "bake", scene, "--cache", "none", "--materials", "lambert", *common]
    until = run(*bake, "-o", folder / "noise", "--noise", noise)
    entries = manifest(folder / "noise")
    most = max(entry["samples"] for entry in entries)
    fixed = run(*bake, "-o", folder / "fixed", "--samples", most)
    run(binary, "reference", scene, *common, "-o", folder / "truth", "--error", noise / 3, "--samples", 65536)
    sums = [within(folder / "noise" / entry["files"][0], folder / "truth" / entry["files"][0]) for entry in entries]
    count, held, difference, total = (sum(one[i] for one in sums) for i in range(4))
    reached = max(entry["standard_error"] for entry in entries)
    samples = sorted(entry["samples"] for entry in entries)
    return (f"| {scene.stem} | {resolution} | {noise:g} % | {100 * reached:.2f} % | {samples[0]} to {samples[-1]} | {until:.0f} s | "
            f"{fixed:.0f} s | {100 * held / count:.1f} % | {100 * difference / total:+.2f} % |")


def main(binary, noise, resolution, *scenes):
    print("| scene | texels | asked for | worst object | samples | CPU time | of all with the most samples | within two errors | mean |")
    print("|---|---|---|---|---|---|---|---|---|")
    for scene in scenes:
        with tempfile.TemporaryDirectory(prefix="rnmbake-errors-") as folder:
            print(row(Path(binary).resolve(), float(noise), int(resolution), Path(scene).resolve(), Path(folder)), flush=True)


main(*sys.argv[1:])
