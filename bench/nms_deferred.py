"""Deferred normal mapping shadows over the G-buffer of scenes/cobbles.py against the exact shadows of its reliefs: the
section "Deferred" of docs/normal-mapping-shadows.md and docs/images/deferred-shadows.png.

    nms_deferred.py [--bench build/release/bench_nms_deferred] [--out out/nms_deferred]
"""
import argparse
import json
import subprocess
import sys
from pathlib import Path

import document
from measure import RNMBAKE, ROOT, run

sys.path.insert(0, str(ROOT / "scenes"))
import patterns  # noqa: E402

PAGE = ROOT / "docs/normal-mapping-shadows.md"
PICTURE = ROOT / "docs/images/deferred-shadows.png"


def rows_of(pattern):
    """Heights in texels, the top row first."""
    side = patterns.SIZE
    heights = [side * height for height in pattern.heights]
    return [heights[side * y:side * (y + 1)] for y in reversed(range(side))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bench", type=Path, default=ROOT / "build/release/bench_nms_deferred")
    parser.add_argument("--out", type=Path, default=ROOT / "out/nms_deferred")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    scene, reliefs = options.out / "cobbles.rnmscene", options.out / "reliefs.json"
    run([RNMBAKE, "-q", "export", ROOT / "scenes/cobbles.toml", "-o", scene])
    reliefs.write_text(json.dumps({name: rows_of(make()) for name, make in patterns.RELIEFS.items()}), encoding="utf-8")
    command = [options.bench, scene, "--reliefs", reliefs, "--character", "figure", "--picture", PICTURE]
    tables = subprocess.run(command, check=True, stdout=subprocess.PIPE, encoding="utf-8").stdout
    document.renew(PAGE, tables, "deferred")


if __name__ == "__main__":
    main()
