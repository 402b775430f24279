"""Seconds of a bake beside those of Cycles."""
from measure import LIVING_ROOM, bake, hall, say
from tables import mebibytes, seconds, table

TITLE = "What rnmbake adds to Cycles"


def measure(options):
    rows = []
    for name, scene in (("hall, 40 objects", hall(40)), ("living room", LIVING_ROOM)):
        if not scene.exists():
            say(f"overhead: {scene} is not there, skipped (LIVING_ROOM names another)")
            continue
        for samples in options.samples or (256,):
            say(f"overhead: {name}, {samples} samples")
            cost = bake(scene, "--resolution", 64, "--samples", samples, "--bounces", 8)
            rows.append({"scene": name, "samples": samples, **cost})
    return {"rows": rows}


def report(data):
    lines = []
    for row in data["rows"]:
        startup = row["launch_seconds"] - row["prepare_seconds"] - row["bake_seconds"] - row["save_seconds"]
        lines.append([row["scene"], str(row["objects"]), str(row["samples"]), seconds(row["wall"]),
                      seconds(row["bake_seconds"]), seconds(row["prepare_seconds"]), seconds(startup),
                      seconds(row["wall"] - row["launch_seconds"]),
                      f"{100 * (row['wall'] / row['bake_seconds'] - 1):.1f} %",
                      mebibytes(row["peak_bytes"]), mebibytes(row["peak"]), f"{row['others']:.1f}"])
    head = ["scene", "objects", "samples", "wall s", "in Cycles s", "build receivers s", "start, load, save s",
            "survey, plan, merge s", "overhead", "peak MiB Blender", "peak MiB rnmbake", "cores others used"]
    return table(head, lines) + (
        "\n\nflat and three bases, 64 x 64 texels for each object, 8 bounces, one launch. \"In Cycles\" is the time "
        "within Blender's bake operator: scene synchronisation, BVH and rays. The goal is 10 % at 256 samples.")
