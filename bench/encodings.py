"""What each encoding loses, over random hemispheres and over the texels of real scenes, into docs/encodings.md.

The truth of a scene is the reference's light at the normals of --basis-set study, traced in one pass with what the
encodings are made from. Probes are written with --probes alone: they are other people's pictures.
"""

import argparse
import json
import pathlib

import document
from measure import RNMBAKE, ROOT, run

PAGE = ROOT / "docs" / "encodings.md"
SCENES = ("cornell", "cave", "panels")
# RMS of irradiance in the reports of https://github.com/kayru/Probulator (Reports/*/report.html).
PUBLISHED = {
    "ambient cube, least squares": {"ennis": .396569, "grace": .0436278, "pisa": .0341202, "uffizi": .181022, "wells": .0486938},
    "sh2": {"ennis": .504977, "grace": .0823762, "pisa": .0234839, "uffizi": .27367, "wells": .0539953},
    "geomerics, as Probulator feeds it":
        {"ennis": .292119, "grace": .0411733, "pisa": .0375623, "uffizi": .135515, "wells": .054672},
    "sh3": {"ennis": .0940183, "grace": .0132446, "pisa": .005105, "uffizi": .0387717}}


def table(lights, out):
    run([RNMBAKE, "-q", "study", "encodings", *lights, "-o", out])
    return (out / "encodings.md").read_text(encoding="utf-8"), json.loads((out / "encodings.json").read_text())


def scene_table(name, args, out):
    truth = out / f"{name}-truth"
    run([RNMBAKE, "-q", "reference", ROOT / "scenes" / "built" / f"{name}.blend", "--basis-set", "study",
         "--resolution", args.resolution, "--error", args.error, "--depth", "float", "-o", truth])
    return table([truth], out / name)


def probe_rows(found):
    """Our figures beside the published ones, and what nobody published."""
    lines = ["| encoding | " + " | ".join(found) + " |", "|---" + "|---:" * len(found) + "|"]
    for row in next(iter(found.values()))["probe"]["encodings"]:
        cells = []
        for name, figure in found.items():
            ours = next(one["rms_by_texel"] for one in figure["probe"]["encodings"] if one["encoding"] == row["encoding"])
            published = PUBLISHED.get(row["encoding"], {}).get(name)
            cells.append(f"{ours:.4f}" + (f" ({published:.4f})" if published else ""))
        lines.append(f"| {row['encoding']} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def hemisphere_rows(found):
    lines = ["| encoding | bytes | " + " | ".join(found) + " |", "|---|---:" + "|---:" * len(found) + "|"]
    for i, row in enumerate(next(iter(found.values()))["encodings"]):
        cells = [f"{100 * figure['encodings'][i]['rms'][1]:.1f}" for figure in found.values()]
        lines.append(f"| {row['label']} | {row['bytes']} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def write_probes(files, out):
    found = {file.stem: table([file], out / file.stem)[1] for file in files}
    document.renew(PAGE, f"""
RMS of E/pi by texel; in brackets what Probulator's reports say.

{probe_rows(found)}

400 surfaces turned at random in the same light, errors in percent of the flat light up to 45 degrees:

{hemisphere_rows(found)}
""", "probes")


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
    parser.add_argument("--resolution", default="16")
    parser.add_argument("--error", default="3", help="percent of an object's mean")
    parser.add_argument("--probes", type=pathlib.Path, nargs="+", metavar="FILE", help="only these probes (.hdr)")
    args = parser.parse_args()
    if args.probes:
        write_probes(args.probes, args.out)
        return
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
