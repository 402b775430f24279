"""cornell_box as another renderer shows it, against our tracer through the same camera.

Irradiance on a diffuse surface is E = pi L / albedo, and both pictures have the same albedo: the ratio of irradiances is
that of the pictures' pixels.
"""
import re
import statistics
import tempfile
from pathlib import Path

from measure import RNMBAKE, WORK, run

PICTURE = "TungstenRender.exr"
SIDE, SAMPLES = 128, 1024
PIXEL = re.compile(r"Pixel \(\d+, \d+\): (.*)")


def compare(scene, blender):
    """The ratio ours / theirs over the pixels that show a surface that does not glow, for each colour."""
    WORK.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=WORK) as folder:
        truth, plain, other = (Path(folder) / f"{name}.exr" for name in ("truth", "plain", "other"))
        common = ["--resolution", f"{SIDE}x{SIDE}", "--blender", blender]
        run([RNMBAKE, "render", scene, "--decode", "truth", "--samples", SAMPLES, *common, "-o", truth])
        run([RNMBAKE, "render", scene, "--decode", "none", *common, "-o", plain])
        run(["oiiotool", scene.parent / PICTURE, "--resize:filter=box", f"{SIDE}x{SIDE}", "-o", other])
        return {"side": SIDE, "samples": SAMPLES, **ratios(pixels(truth), pixels(plain), pixels(other))}


def pixels(picture):
    """Lists of channels: R, G, B, and in ours coverage and the albedo."""
    text = run(["oiiotool", "--dumpdata", picture])["output"]
    return [[float(word) for word in line.split()] for line in PIXEL.findall(text)]


def ratios(truth, plain, other):
    shown = [(ours, theirs) for ours, albedo, theirs in zip(truth, plain, other) if diffuse(albedo)]
    colours = [[ours[c] / theirs[c] for ours, theirs in shown if theirs[c] > 0] for c in range(3)]
    together = sorted(ratio for colour in colours for ratio in colour)
    return {"pixels": len(shown), "median": statistics.median(together),
            "p05": together[len(together) // 20], "p95": together[-len(together) // 20],
            "medians": [statistics.median(colour) for colour in colours],
            "mean": sum(sum(ours[:3]) for ours, _ in shown) / sum(sum(theirs[:3]) for _, theirs in shown)}


def diffuse(pixel):
    """All of it shows surfaces, which reflect something in each colour and do not glow."""
    light, coverage, albedo = pixel[:3], pixel[3], pixel[4:7]
    return coverage > 0.999 and min(albedo) > 0.01 and all(abs(a - b) < 1e-3 for a, b in zip(light, albedo))
