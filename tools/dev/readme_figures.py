"""Renews the figures that README.md quotes: what validate found on the courtyard, and how far its views are off.

    readme_figures.py VALIDATE/report.json VIEWS/report.json
"""
import json
import re
import sys
import textwrap
from pathlib import Path

README = Path(__file__).resolve().parents[2] / "README.md"


def main():
    found, views = (json.loads(Path(name).read_text(encoding="utf-8")) for name in sys.argv[1:3])
    text = README.read_text(encoding="utf-8")
    text = renewed(text, "finding", finding(found))
    text = renewed(text, "views", view_errors(views))
    README.write_text(text, encoding="utf-8")


def finding(report):
    blender = next(one["value"] for one in report["versions"] if one["key"] == "receiver: Blender")
    return (f"*Found on the courtyard (Blender {blender}): \"{report['finding']}\" Errors of both signs cancel in this mean, not in "
            "the maps ([docs/accuracy.md](docs/accuracy.md)).*")


def view_errors(report):
    off = {one["label"]: f"{100 * one['relative_rmse']:.0f} %"
           for one in report["views"][0]["pictures"] if "relative_rmse" in one}
    return (f"*Above: Cycles, and the tracer. Below: the plain lightmap ({off['single lightmap']} off the truth, RMSE), in which the "
            f"normal maps are lost, and the three maps ({off['RNM, squared']}), baked with `--normalize flat`. Cycles itself is "
            f"{off['Cycles']} off, since it [darkens or bends normals](docs/render.md#cycles).*")


def renewed(text, name, figures):
    begin, end = f"<!-- {name}: begin -->\n", f"<!-- {name}: end -->"
    lines = textwrap.fill(figures, 127, break_long_words=False, break_on_hyphens=False)
    text, count = re.subn(f"{begin}.*?{end}", lambda _: begin + lines + "\n" + end, text, flags=re.DOTALL)
    if count != 1:
        raise SystemExit(f"README.md has no place for '{name}'")
    return text


if __name__ == "__main__":
    main()
