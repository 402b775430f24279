"""hall at 10, 40 and 160 objects, 64 x 64 texels, 64 samples, by each --dispatch."""
from measure import bake, hall, say
from tables import mebibytes, seconds, table

TITLE = "One launch for each basis, each object or the whole scene"
MODES = ("basis", "object", "scene")
SHELL = 6  # objects that every hall has once
SHELL_GLOBS = "floor,vault,wall_*"
PROPS_GLOB = "*_??0"  # every tenth pillar or statue
FLAGS = ("--resolution", 64, "--samples", 64, "--bounces", 8)


def measure(options):
    rows = []
    for objects in options.objects or (10, 40, 160):
        for mode in MODES:
            say(f"dispatch: {objects} objects, {mode}")
            sampled = objects > 100 and mode != "scene" and not options.full
            one = (measure_sample if sampled else measure_whole)(objects, mode)
            rows.append({"objects": objects, "mode": mode, "extrapolated": sampled, **one})
    return {"rows": rows}


def measure_whole(objects, mode):
    cost = bake(hall(objects), "--dispatch", mode, *FLAGS)
    return {key: cost[key] for key in ("wall", "cpu", "launches", "bake_seconds", "peak_bytes", "busy_before")}


def measure_sample(objects, mode):
    """The shell and every tenth prop, in two runs; the props' share is scaled up to all of them."""
    scene = hall(objects)
    shell = bake(scene, "--dispatch", mode, "--objects", SHELL_GLOBS, *FLAGS)
    props = bake(scene, "--dispatch", mode, "--objects", PROPS_GLOB, *FLAGS)
    factor = (objects - SHELL) / props["objects"]
    around = (shell["wall"] - shell["wall_seconds"] + props["wall"] - props["wall_seconds"]) / 2
    return {
        "wall": around + shell["wall_seconds"] + factor * props["wall_seconds"],
        "cpu": shell["cpu"] + factor * props["cpu"],
        "launches": round(shell["launches"] + factor * props["launches"]),
        "bake_seconds": shell["bake_seconds"] + factor * props["bake_seconds"],
        "peak_bytes": max(shell["peak_bytes"], props["peak_bytes"]),
        "busy_before": max(shell["busy_before"], props["busy_before"]),
        "measured_objects": shell["objects"] + props["objects"], "factor": factor,
        "measured_wall": shell["wall"] + props["wall"]}


def report(data):
    wall = {(row["objects"], row["mode"]): row["wall"] for row in data["rows"]}
    cpu = {(row["objects"], row["mode"]): row["cpu"] for row in data["rows"]}
    lines = []
    for row in data["rows"]:
        scene = wall.get((row["objects"], "scene"))
        lines.append([str(row["objects"]), f"`{row['mode']}`", str(row["launches"]),
                      seconds(row["wall"]) + (" (e)" if row["extrapolated"] else ""), seconds(row["cpu"]),
                      f"{row['wall'] / scene:.1f}" if scene else "",
                      mebibytes(row["peak_bytes"]), f"{row['busy_before']:.1f}"])
    text = [table(["objects", "`--dispatch`", "launches", "wall s", "CPU s", "x `scene`", "peak MiB of a launch",
                   "cores busy before"], lines)]
    for row in data["rows"]:
        if row["extrapolated"]:
            text.append(
                f"(e) `{row['mode']}` at {row['objects']} objects is extrapolated: {row['measured_objects']} objects "
                f"(the shell and every tenth pillar or statue) were baked in {row['measured_wall']:.0f} s and the "
                f"pillars' and statues' share multiplied by {row['factor']:.2f}. `--full` measures all.")
    text.append(claims(wall, cpu))
    return "\n\n".join(text)


def claims(wall, cpu):
    asked = [("40 objects: `basis` / `scene`", wall, (40, "basis"), (40, "scene"), "at least 4", 4, True),
             ("160 objects: `basis` / `scene`", wall, (160, "basis"), (160, "scene"), "at least 10", 10, True),
             ("`scene`: 160 / 40 objects", wall, (160, "scene"), (40, "scene"), "at most 4.4", 4.4, False)]
    lines = []
    for name, times, above, below, goal, bound, least in asked:
        if above in times and below in times:
            ratio = times[above] / times[below]
            met = ratio >= bound if least else ratio <= bound
            lines.append([name, goal, f"{ratio:.2f}", f"{cpu[above] / cpu[below]:.2f}", "yes" if met else "**no**"])
    return table(["ratio", "goal", "wall", "CPU", "met (wall)"], lines)
