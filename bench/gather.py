"""Noise and time of recipe gather beside receiver: of single texels, and of means over 8 x 8.

    python3 bench/gather.py BINARY SCENE [SAMPLES] [REFERENCE_SAMPLES] [--basis-set NAME]

Errors are against the reference, relative to each map's mean (RMS over all maps of all objects), so the scene should be
diffuse. Efficiency: receiver's squared error x processor time over gather's.
"""
import argparse
import math
from pathlib import Path
import tempfile

import measure
from lightmaps import read_picture

SIDE = 8  # of the means, texels


def run(binary, *words):
    """Processor seconds of a run without a cache."""
    return measure.run([binary, *words, "--depth", "float", "--resolution", "32", "--save-scene", "never", "--cache", "none",
                        "--dilate", "0", "-q"])["cpu"]


def pictures(folder):
    return {file.stem: read_picture(file)[2] for file in sorted(Path(folder).glob("*.exr"))}


def map_errors(truth, rows, channel):
    """Relative mean squares of one map's texels and of its whole squares; None where it is black."""
    total, squares, count, sums = 0, 0, 0, {}
    for y, (true_row, row) in enumerate(zip(truth, rows)):
        for x, (true, texel) in enumerate(zip(true_row, row)):
            if true["coverage"] <= 0:
                continue
            difference = texel[channel] - true[channel]
            total, squares, count = total + true[channel], squares + difference ** 2, count + 1
            entry = sums.setdefault((y // SIDE, x // SIDE), [0, 0])
            entry[0], entry[1] = entry[0] + difference, entry[1] + 1
    whole = [sum_ / SIDE ** 2 for sum_, texels in sums.values() if texels == SIDE ** 2]
    if total <= 0 or not whole:
        return None
    mean = total / count
    return squares / count / mean ** 2, sum(value ** 2 for value in whole) / len(whole) / mean ** 2


def errors(truth, found):
    channels = [name for name in next(iter(truth.values()))[0][0] if name.split(".")[-1] in "RGB"]
    channels = [name for name in channels if "stderr" not in name]
    pairs = [map_errors(truth[name], found[name], channel) for name in truth for channel in channels]
    pairs = [pair for pair in pairs if pair]
    return [sum(values) / len(pairs) for values in zip(*pairs)]


def absolute(path):
    return Path(path).resolve()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=absolute)
    parser.add_argument("scene", type=absolute)
    parser.add_argument("samples", nargs="?", default="256")
    parser.add_argument("reference_samples", nargs="?", default="8192")
    parser.add_argument("--basis-set", default="rnm")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="rnmbake-gather-") as folder:
        common = [given.scene, "--basis-set", given.basis_set]
        run(given.binary, "reference", *common, "-o", f"{folder}/truth", "--samples", given.reference_samples)
        truth, rows = pictures(f"{folder}/truth"), {}
        for recipe in ("receiver", "gather"):
            seconds = run(given.binary, "bake", *common, "-o", f"{folder}/{recipe}", "--recipe", recipe, "--materials", "lambert",
                          "--samples", given.samples)
            rows[recipe] = (seconds, *errors(truth, pictures(f"{folder}/{recipe}")))
    print("| recipe | CPU s | noise of a texel | of 8 x 8 means |\n|---|---|---|---|")
    for recipe, (seconds, texel, means) in rows.items():
        print(f"| {recipe} | {seconds:.1f} | {100 * math.sqrt(texel):.2f} % | {100 * math.sqrt(means):.2f} % |")
    ratios = [rows["receiver"][0] * rows["receiver"][k] / (rows["gather"][0] * rows["gather"][k]) for k in (1, 2)]
    print(f"| efficiency | | {ratios[0]:.1f} | {ratios[1]:.2f} |")


if __name__ == "__main__":
    main()
