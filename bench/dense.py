"""What a bake costs before its first sample, where meshes are finer than their lightmaps."""
from measure import BLENDER, HEADLESS, ROOT, RNMBAKE, WORK, bake, run, say
from tables import mebibytes, seconds, table

TITLE = "Meshes finer than their lightmaps"
STATUES = 12
BASES = 4


def measure(options):
    """`options.before`: another rnmbake that takes turns with this one."""
    scene = make_scene()
    rows = []
    for resolution, samples in ((16, 1), (64, 1), (64, 16)):
        for build in filter(None, (options.before, RNMBAKE)):
            name = "now" if build == RNMBAKE else "before"
            say(f"dense: {name}, {resolution} x {resolution}, {samples} samples")
            cost = bake(scene, "--resolution", resolution, "--samples", samples, "--bounces", 8, rnmbake=build)
            rows.append({"build": name, "resolution": resolution, "samples": samples, **cost})
    return {"rows": rows}


def make_scene():
    path, script = WORK / "statues.blend", ROOT / "bench/in_blender/make_statues.py"
    if not path.exists() or path.stat().st_mtime < script.stat().st_mtime:
        WORK.mkdir(parents=True, exist_ok=True)
        run([BLENDER, *HEADLESS, "--python", script, "--", STATUES, path])
    return path


def report(data):
    lines = []
    for row in data["rows"]:
        side = row["resolution"]
        lines.append([row["build"], f"{side} x {side}", str(row["samples"]), seconds(row["wall"]), seconds(row["cpu"]),
                      seconds(row["launch_seconds"]), seconds(row["prepare_seconds"]), seconds(row["bake_seconds"]),
                      mebibytes(row["peak_bytes"]), mebibytes(row["peak"]), f"{row['others']:.1f}"])
    first = data["rows"][0]
    head = ["rnmbake", "texels each", "samples", "wall s", "CPU s", "launch s", "build receivers s", "in Cycles s",
            "peak MiB Blender", "peak MiB rnmbake", "cores others used"]
    return table(head, lines) + (
        f"\n\n{first['objects']} statues, {first['triangles']} triangles, flat and three bases: "
        f"{BASES * first['triangles']} receiver triangles, of which only those that hold a texel's centre are sent to "
        "Blender. \"Before\" (`--before BINARY`) is rnmbake that sends all. The lightmaps of both are the same, bit for bit "
        "(in Blender 5.0 but for the last digit of a texel in thousands). Wall has the survey and the unwrap in it.\n\n"
        "Of a launch of 2.3 s (64 x 64 texels, 1 sample, little else running) 1.0 is Blender's start with the scene, 0.3 are the "
        "receivers, nearly all of it custom normals, and 1.1 the bake operator, two thirds of it Cycles. Looked at and left "
        "alone: the fences (1,782 here, milliseconds; receivers beside them may stand in their shadow, so those of faces between "
        "texels stay); lists for `normals_split_custom_set_from_vertices`, which knows no buffers before 4.5; and leaving triangles "
        "out before their corner normals are made (all of the planning in C++ takes about 0.2 s).")
