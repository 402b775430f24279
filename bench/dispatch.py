"""hall at 10, 40 and 160 objects, 64 x 64 texels, 64 samples, by each --dispatch."""
import os

from measure import bake, hall, say
from tables import mebibytes, seconds, table

TITLE = "One launch for each basis, each object or the whole scene"
MODES = (("basis", 1), ("basis", os.cpu_count()), ("object", 1), ("scene", 1))  # --dispatch, --jobs
SHELL = 6  # objects that every hall has once
SHELL_GLOBS = "floor,vault,wall_*"
PROPS_GLOB = "*_??0"  # every tenth pillar or statue
FLAGS = ("--resolution", 64, "--samples", 64, "--bounces", 8)


def measure(options):
    rows = []
    for objects in options.objects or (10, 40, 160):
        for mode, jobs in MODES:
            say(f"dispatch: {objects} objects, {mode}, {jobs} at a time")
            sampled = objects > 100 and mode != "scene" and not options.full
            flags = ("--dispatch", mode, "--jobs", jobs, *FLAGS)
            one = (measure_sample if sampled else measure_whole)(objects, flags)
            rows.append({"objects": objects, "mode": mode, "jobs": jobs, "extrapolated": sampled, **one})
    return {"rows": rows}


def measure_whole(objects, flags):
    cost = bake(hall(objects), *flags)
    return {key: cost[key] for key in ("wall", "cpu", "launches", "bake_seconds", "peak_bytes", "others")}


def measure_sample(objects, flags):
    """The shell and every tenth prop, in two runs; the props' share is scaled up to all of them."""
    scene = hall(objects)
    shell = bake(scene, "--objects", SHELL_GLOBS, *flags)
    props = bake(scene, "--objects", PROPS_GLOB, *flags)
    factor = (objects - SHELL) / props["objects"]
    around = (shell["wall"] - shell["wall_seconds"] + props["wall"] - props["wall_seconds"]) / 2
    return {
        "wall": around + shell["wall_seconds"] + factor * props["wall_seconds"],
        "cpu": shell["cpu"] + factor * props["cpu"],
        "launches": round(shell["launches"] + factor * props["launches"]),
        "bake_seconds": shell["bake_seconds"] + factor * props["bake_seconds"],
        "peak_bytes": max(shell["peak_bytes"], props["peak_bytes"]),
        "others": max(shell["others"], props["others"]),
        "measured_objects": shell["objects"] + props["objects"], "factor": factor,
        "measured_wall": shell["wall"] + props["wall"]}


def report(data):
    wall = {(row["objects"], row["mode"], row["jobs"]): row["wall"] for row in data["rows"]}
    cpu = {(row["objects"], row["mode"], row["jobs"]): row["cpu"] for row in data["rows"]}
    lines = []
    for row in data["rows"]:
        scene = wall.get((row["objects"], "scene", 1))
        lines.append([str(row["objects"]), f"`{row['mode']}`", str(row["jobs"]), str(row["launches"]),
                      seconds(row["wall"]) + (" (e)" if row["extrapolated"] else ""), seconds(row["cpu"]),
                      f"{row['wall'] / scene:.1f}" if scene else "",
                      mebibytes(row["peak_bytes"]), f"{row['others']:.1f}"])
    text = ["`hall`, flat and three bases, 64 x 64 texels for each object, 64 samples, 8 bounces. One Blender at a time "
            "(`--jobs 1`, each on all cores) is how bakes for each object and basis are published; rnmbake by itself runs "
            "as many at a time as there are cores, which helps where starting Blender costs more than baking.",
            table(["objects", "`--dispatch`", "`--jobs`", "launches", "wall s", "CPU s", "x `scene`",
                   "peak MiB of a launch", "cores others used"], lines)]
    for row in data["rows"]:
        if row["extrapolated"]:
            text.append(
                f"(e) `{row['mode']}`, `--jobs {row['jobs']}`, at {row['objects']} objects is extrapolated: "
                f"{row['measured_objects']} objects (the shell and every tenth pillar or statue) were baked in "
                f"{row['measured_wall']:.0f} s and the pillars' and statues' share multiplied by {row['factor']:.2f}. "
                "`--full` measures all.")
    text.append(claims(wall, cpu))
    return "\n\n".join(text)


def claims(wall, cpu):
    cores = os.cpu_count()
    asked = [(f"40 objects: `basis` / `scene`, {jobs} at a time", (40, "basis", jobs), (40, "scene", 1), "at least 4", 4, True)
             for jobs in (1, cores)]
    asked += [(f"160 objects: `basis` / `scene`, {jobs} at a time", (160, "basis", jobs), (160, "scene", 1), "at least 10",
               10, True) for jobs in (1, cores)]
    asked.append(("`scene`: 160 / 40 objects", (160, "scene", 1), (40, "scene", 1), "at most 4.4", 4.4, False))
    lines = []
    for name, above, below, goal, bound, least in asked:
        if above in wall and below in wall:
            ratio = wall[above] / wall[below]
            met = ratio >= bound if least else ratio <= bound
            lines.append([name, goal, f"{ratio:.2f}", f"{cpu[above] / cpu[below]:.2f}", "yes" if met else "**no**"])
    return table(["ratio", "goal", "wall", "CPU", "met (wall)"], lines)
