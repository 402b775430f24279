"""One view of panels as Cycles, Eevee and each encoding show it, into docs/encodings.md and docs/images/encodings.jpg."""
import argparse
import json
import pathlib
import re
import subprocess

import document
import mosaic
from measure import RNMBAKE, ROOT, run

PAGE, PICTURE = ROOT / "docs" / "encodings.md", ROOT / "docs" / "images" / "encodings.jpg"
SCENE = ROOT / "scenes" / "built" / "panels.blend"
ENCODINGS = {"sh2": [], "zh3": [], "zh3-packed": ["--range", "2", "--bits", "8", "--mono"], "geomerics": [], "ahd": [],
             "h6": [], "sg": []}
WIDTH, HEIGHT, COLUMNS = 320, 200, 3


def views(out, args):
    """Report of the comparison; its folder holds the pictures."""
    run([RNMBAKE, "-q", "reference", SCENE, "-o", out / "bakes", "--basis-set", "h6", "--resolution", args.resolution,
         "--samples", args.texel_samples])
    for name, flags in ENCODINGS.items():
        run([RNMBAKE, "-q", "convert", out / "bakes", "--to", name.split("-")[0], *flags, "-o", out / name])
    lightmaps = [word for name in ("bakes", *ENCODINGS) for word in ("--lightmaps", out / name)]
    run([RNMBAKE, "-q", "render", SCENE, "--compare", "--with", "eevee", *lightmaps, "--resolution", f"{WIDTH}x{HEIGHT}",
         "--samples", args.samples, "-o", out / "views"])
    return json.loads((out / "views" / "report.json").read_text(encoding="utf-8"))["views"][0]["pictures"]


def words(picture):
    size = f", {picture['bytes']} bytes" if "bytes" in picture else ""
    error = f": {100 * picture['relative_rmse']:.1f} %" if "relative_rmse" in picture else ""
    return picture["label"] + size + error


def shown(pictures, folder):
    """[(words, picture)], as a screen shows it."""
    figures = []
    for picture in pictures:
        name = re.sub("[^a-z0-9]+", "-", picture["label"].lower()).strip("-")
        subprocess.run(["oiiotool", folder / f"{name}.exr", "--ch", "R,G,B", "--clamp:min=0:max=1", "--colorconvert", "linear",
                        "sRGB", "-d", "uint8", "-o", folder / f"{name}.png"], check=True)
        figures.append((words(picture), folder / f"{name}.png"))
    return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out" / "encoding-views")
    parser.add_argument("--resolution", default="128", help="texels along a side of a lightmap")
    parser.add_argument("--texel-samples", default="64")
    parser.add_argument("--samples", default="256", help="of a pixel")
    args = parser.parse_args()
    pictures = views(args.out, args)
    folder = args.out / "views"
    mosaic.write(shown(pictures, folder), folder, COLUMNS, (WIDTH, HEIGHT), 13, 80, PICTURE)
    rows = [f"| {p['label']} | {p.get('bytes', '')} | {100 * p['relative_rmse']:.1f} | {100 * p['relative_bias']:+.1f} |"
            for p in pictures if "relative_rmse" in p]
    document.renew(PAGE, "\n| | bytes | RMSE, % of the truth's mean | bias % |\n|---|---:|---:|---:|\n" + "\n".join(rows)
                   + "\n", "views")


if __name__ == "__main__":
    main()
