"""A statue in the light of probes beside the truth, into docs/volumes.md and docs/images/volumes.jpg."""
import json
import re
import subprocess

import document
import measure
import mosaic
from measure import RNMBAKE, ROOT, run

PAGE, PICTURE = ROOT / "docs" / "volumes.md", ROOT / "docs" / "images" / "volumes.jpg"
# scene: statue's turn and place, camera's place, --bounds, --spacing, exposure in stops
VIEWS = {"hall": (0, "0.3,4.9,1.1", "0,2.6,1.5", "-5.2,0,0,5.2,12.8,4.6", 1, 1),
         "two_rooms": (180, "4.72,0.62,1.1", "5.4,2.9,1.5", "0,0,0,8.1,4,3", 1.3, 3)}
SHOWN = {"truth": "truth", "cube probes (visibility test)": "cube, leak test",
         "sh3 probes (no leak test)": "sh3, no leak test", "sh3 probes (visibility test)": "sh3, leak test"}
SIDE, WIDTH = 240, 1.1  # pixels of a picture; units of the statue


def view(name, out, samples):
    """[(words, picture, row of the report)] of one scene."""
    turn, place, camera, bounds, spacing, stops = VIEWS[name]
    out.mkdir(parents=True, exist_ok=True)
    blend = (out / f"{name}.blend").resolve()
    measure.blender("add_statue.py", blend, WIDTH, turn, place, camera, scene=ROOT / "scenes" / "built" / f"{name}.blend")
    run([RNMBAKE, "-q", "probes", blend, "-o", out / "probes", f"--bounds={bounds}", "--spacing", spacing, "--dynamic", "statue",
         "--lights", "static", "--check", "0"])
    run([RNMBAKE, "-q", "render", blend, "--probes", out / "probes", "--compare", "--resolution", f"{SIDE}x{SIDE}", "--samples",
         samples, "-o", out / "views"])
    run([RNMBAKE, "-q", "render", blend, "--gbuffer", "--resolution", f"{SIDE}x{SIDE}", "-o", out / "gbuffer.exr"])
    mask = mask_of(out / "gbuffer.exr")
    report = json.loads((out / "views" / "report.json").read_text(encoding="utf-8"))["views"][0]["pictures"]
    rows = {row["label"]: row for row in report}
    return [(f"{name.replace('_', ' ')}: {words}", picture_of(out / "views", label, mask, stops), rows[label])
            for label, words in SHOWN.items()]


def mask_of(gbuffer):
    """1 at the pixels of the statue, three channels."""
    header = subprocess.run(["oiiotool", "--info", "-v", gbuffer], check=True, capture_output=True, text=True).stdout
    number = json.loads(re.search(r'rnmbake:objects: "(.*)"', header)[1]).index("statue") + 1
    mask = gbuffer.with_name("mask.exr")
    subprocess.run(["oiiotool", gbuffer, "--ch", "object,object,object", "--absdiffc", str(number), "--mulc", "-1000", "--addc", "1",
                    "--clamp:min=0:max=1", "--chnames", "R,G,B", "-o", mask], check=True)
    return mask


def picture_of(folder, label, mask, stops):
    """The statue before the truth's background, which the others have traced with few samples."""
    name = re.sub("[^a-z0-9]+", "-", label.lower()).strip("-")
    picture, truth = folder / f"{name}.exr", folder / "truth.exr"
    subprocess.run(["oiiotool", picture, truth, "--sub", mask, "--mul", truth, "--add", "--mulc", str(2 ** stops),
                    "--clamp:min=0:max=1", "--colorconvert", "linear", "sRGB", "-d", "uint8", "-o", picture.with_suffix(".png")],
                   check=True)
    return picture.with_suffix(".png")


def error_of(row):
    return f": {100 * row['relative_rmse']:.1f} %" if "relative_rmse" in row else ""


def write(out, samples):
    """`samples`: of a pixel of the truth."""
    out = out.resolve()
    shown = [one for name in VIEWS for one in view(name, out / name, samples)]
    figures = [(words + error_of(row), picture) for words, picture, row in shown]
    mosaic.write(figures, out, len(SHOWN), (SIDE, SIDE), 12, 85, PICTURE)
    rows = [f"| {words} | {100 * row['relative_rmse']:.1f} | {100 * row['relative_bias']:+.1f} |"
            for words, _, row in shown if "relative_rmse" in row]
    document.renew(PAGE, "\n| over the statue's pixels | RMSE, % of the truth's mean | bias % |\n|---|---:|---:|\n" + "\n".join(rows)
                   + "\n", "views")


if __name__ == "__main__":
    write(ROOT / "out" / "volume-views", "192")
