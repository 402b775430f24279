"""Seconds of each start of Blender in a small bake."""
import tempfile
from pathlib import Path

from measure import BLENDER, ROOT, WORK, bake, run, say
from tables import seconds, table

TITLE = "Small bakes"
WRAPPER = """#!/bin/bash
start=$EPOCHREALTIME
"{blender}" "$@"
code=$?
what=--version
for word; do case $word in *_entry.py) what=${{word##*/}} ;; esac; done
echo "$what $start $EPOCHREALTIME" >>"{log}"
exit $code
"""


def measure(options):
    del options
    rows = []
    for name in ("plane_sun", "cornell"):
        say(f"startup: {name}")
        scene = ROOT / f"scenes/built/{name}.blend"
        with tempfile.TemporaryDirectory(dir=WORK) as folder:
            log, wrapper = Path(folder) / "starts", Path(folder) / "blender"
            wrapper.write_text(WRAPPER.format(blender=BLENDER, log=log), encoding="utf-8")
            wrapper.chmod(0o755)
            cost = bake(scene, "--blender", wrapper, "--resolution", 64, "--samples", 16)
            starts = [(what, float(end) - float(start)) for what, start, end in
                      (line.split() for line in log.read_text(encoding="ascii").splitlines())]
        rows.append({"scene": name, "starts": starts, **cost})
    bare = run([BLENDER, "-b", "--factory-startup", "-noaudio", "--python-expr", "pass"])
    return {"rows": rows, "bare_start": bare["wall"], "bare_start_cpu": bare["cpu"]}


def report(data):
    lines = []
    for row in data["rows"]:
        total = sum(length for _, length in row["starts"])
        starts = ", ".join(f"`{what}` {seconds(length)}" for what, length in row["starts"])
        lines.append([row["scene"], seconds(row["wall"]), starts, seconds(row["bake_seconds"]),
                      seconds(row["wall"] - total)])
    return table(["scene", "wall s", "starts of Blender, s", "in Cycles s", "outside Blender s"], lines) + (
        f"\n\n64 x 64 texels, 16 samples. A Blender that only starts and ends takes {data['bare_start']:.2f} s "
        f"({data['bare_start_cpu']:.2f} s of processor time), so two of them are the floor: one to survey, one to bake.")
