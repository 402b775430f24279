"""Blender's bytes for each atlas pixel, triangle of the scene and triangle of receivers."""
import re

from measure import ROOT, WORK, HEADLESS, BLENDER, bake, run, say
from tables import mebibytes, table

TITLE = "Memory"
FLAGS = ("--samples", 1, "--bounces", 1, "--bases", "flat", "--jobs", 1)
SIDES = (1024, 2048, 4096)
TRIANGLES = (20_000, 200_000, 800_000)


def grid_scene(triangles):
    path = WORK / f"grid_{triangles}.blend"
    if not path.exists():
        WORK.mkdir(parents=True, exist_ok=True)
        run([BLENDER, *HEADLESS, "--python", ROOT / "bench/in_blender/make_grid.py", "--", triangles, path])
    return path


def measure(options):
    del options
    pixels = []
    for side in SIDES:
        say(f"memory: atlas of {side} x {side}")
        cost = bake(grid_scene(TRIANGLES[0]), "--objects", "small", "--resolution", side, "--atlas-limit", side * side,
                    *FLAGS)
        pixels.append({"count": side * side, "peak_bytes": cost["peak_bytes"], "driver": cost["peak"]})
    scene, receivers = [], []
    for count in TRIANGLES:
        say(f"memory: {count} triangles")
        cost = bake(grid_scene(count), "--objects", "small", "--resolution", 16, *FLAGS)
        scene.append({"count": count, "peak_bytes": cost["peak_bytes"], "driver": cost["peak"]})
        cost = bake(grid_scene(count), "--objects", "grid", "--resolution", 64, *FLAGS)
        receivers.append({"count": count, "peak_bytes": cost["peak_bytes"], "driver": cost["peak"]})
    return {"pixels": pixels, "scene": scene, "receivers": with_scene_taken_off(receivers, scene)}


def with_scene_taken_off(receivers, scene):
    """The grid itself is in the scene too; what is left is the receivers' own."""
    return [{**row, "peak_bytes": row["peak_bytes"] - alone["peak_bytes"] + scene[0]["peak_bytes"]}
            for row, alone in zip(receivers, scene)]


def slope(rows, what):
    """Bytes for each one more, between the last two sizes."""
    return (rows[-1][what] - rows[-2][what]) / (rows[-1]["count"] - rows[-2]["count"])


def constants():
    text = (ROOT / "src/bake/plan.h").read_text(encoding="utf-8")
    return dict(re.findall(r"std::int64_t (bytes_per_\w+) = (\d+);", text))


def report(data):
    known = constants()
    lines = []
    for name, key, constant in (("pixel of an atlas", "pixels", "bytes_per_pixel"),
                                ("triangle of the scene", "scene", "bytes_per_scene_triangle"),
                                ("triangle of a receiver", "receivers", "bytes_per_receiver_triangle")):
        rows = data[key]
        sizes = ", ".join(f"{row['count'] / 1e6:.2f} M: {mebibytes(row['peak_bytes'])}" for row in rows)
        lines.append([name, sizes, f"{slope(rows, 'peak_bytes'):.0f}", f"{slope(rows, 'driver'):.0f}",
                      f"{known[constant]} (`{constant}`)"])
    return table(["one more", "Blender's peak, MiB", "bytes each in Blender", "bytes each in rnmbake",
                  "assumed in `src/bake/plan.h`"], lines) + (
        "\n\nOne basis; four bases make four receiver triangles of each. The receivers' rows have the memory of the "
        "scene's own copy of the grid taken off. The assumptions decide how large an atlas may get; they are rounded "
        "up so that a plan fits.")
