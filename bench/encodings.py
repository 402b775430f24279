"""What each encoding loses, over random hemispheres and over the texels of real scenes, into docs/encodings.md.

The truth of a scene is the reference's light at the normals of scenes/study.toml, traced in one pass with what the
encodings are made from.
"""

import argparse
import json
import pathlib

import document
from measure import RNMBAKE, ROOT, run

PAGE = ROOT / "docs" / "encodings.md"
SCENES = ("cornell", "cave", "panels")


def table(lights, out):
    run([RNMBAKE, "-q", "study", "encodings", *lights, "-o", out])
    return (out / "encodings.md").read_text(encoding="utf-8"), json.loads((out / "encodings.json").read_text())


def scene_table(name, args, out):
    truth = out / f"{name}-truth"
    run([RNMBAKE, "-q", "reference", ROOT / "scenes" / "built" / f"{name}.blend", "--basis", ROOT / "scenes" / "study.toml",
         "--resolution", args.resolution, "--error", args.error, "--depth", "float", "-o", truth])
    return table([truth], out / name)


def findings(figures):
    """Sentences that compare, out of the figures."""
    def rms(figure, encoding, limit):
        rows = {row["label"]: row for row in figure["encodings"] if "rms" in row}
        return 100 * rows[encoding]["rms"][figure["tilt_limits"].index(limit)]

    lines = []
    for name, figure in figures.items():
        lines.append(f"- {name}: up to 45 degrees a plain lightmap is off by {rms(figure, 'flat', 45):.1f} %, Source's RNM by "
                     f"{rms(figure, 'rnm-vrad', 45):.1f} %, the linear SH-2 by {rms(figure, 'sh2', 45):.1f} % and the refitted "
                     f"ZH3 by {rms(figure, 'zh3', 45):.1f} %, from the same four bakes.")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out" / "encodings")
    parser.add_argument("--resolution", default="64")
    parser.add_argument("--error", default="1", help="percent of an object's mean")
    args = parser.parse_args()
    page, figures = [], {}
    text, figures["random"] = table(["random", "--count", "400"], args.out / "random")
    page.append(f"## 400 random hemispheres\n\n`rnmbake study encodings random`\n\n{text}")
    for name in SCENES:
        text, figures[name] = scene_table(name, args, args.out)
        lights = figures[name]["lights"]
        page.append(f"## {name}\n\n{lights} texels of `scenes/{name}.py` at {args.resolution} texels a side, traced to {args.error} % "
                    f"of each object's mean.\n\n{text}")
    page.insert(0, "\n## In short\n\n" + findings(figures) + "\n")
    document.renew(PAGE, "\n".join(page))


if __name__ == "__main__":
    main()
