"""cornell_box as another renderer shows it, against our tracer through the same camera.

Irradiance on a diffuse surface is E = pi L / albedo, and both pictures have the same albedo: the ratio of irradiances is
that of the pictures' pixels.
"""
import re
import statistics
import tempfile
from pathlib import Path

from measure import RNMBAKE, WORK, blender, run

PICTURE = "TungstenRender.exr"
SIDE, SAMPLES = 128, 512
PIXEL = re.compile(r"Pixel \(\d+, \d+\): (.*)")


def compare(scene, blender_path):
    """The ratio ours / theirs over the pixels that show a surface that does not glow, for each colour.

    The scene's lamp shines downwards only, by its material's node tree. Our model has no such lamp, so there are two
    answers: for the scene as it is, and with a black back on the lamp.
    """
    WORK.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=WORK) as folder:
        other, shielded = Path(folder) / "other.exr", Path(folder) / "shielded.blend"
        run(["oiiotool", scene.parent / PICTURE, "--resize:filter=box", f"{SIDE}x{SIDE}", "-o", other])
        blender("shield_lamps.py", shielded, scene=scene)
        theirs = pixels(other)
        return {"side": SIDE, "samples": SAMPLES, "as_it_is": ratios(*view(scene, blender_path), theirs),
                "shielded": ratios(*view(shielded, blender_path), theirs)}


def view(scene, blender_path):
    """Our two pictures of it: traced, and with light of 1 everywhere."""
    with tempfile.TemporaryDirectory(dir=WORK) as folder:
        pictures = []
        for how, samples in (("truth", SAMPLES), ("none", 16)):
            picture = Path(folder) / f"{how}.exr"
            run([RNMBAKE, "render", scene, "--decode", how, "--samples", samples, "--resolution", f"{SIDE}x{SIDE}",
                 "--blender", blender_path, "-o", picture])
            pictures.append(pixels(picture))
        return pictures


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
    """Whether the whole pixel shows surfaces that reflect each colour and do not glow."""
    light, coverage, albedo = pixel[:3], pixel[3], pixel[4:7]
    return coverage > 0.999 and min(albedo) > 0.01 and all(abs(a - b) < 1e-3 for a, b in zip(light, albedo))
