"""Preparing the living room's receivers: Python lists for each corner against arrays and C++."""
import json
import os
import tempfile
from pathlib import Path

from measure import BLENDER, HEADLESS, LIVING_ROOM, ROOT, RNMBAKE, WORK, blender, run, say
from tables import seconds, table

TITLE = "Preparing receivers"
PLANNING = Path(os.environ.get("BENCH_PLANNING", RNMBAKE.parent / "bench_planning"))
CHANGES = ROOT / "bench/results/planning_changes.json"
NOT_A_BAKE = "uv report (inspect only)"


def measure(options):
    del options
    if not LIVING_ROOM.exists():
        raise SystemExit(f"bench: {LIVING_ROOM} is not there; LIVING_ROOM names another scene")
    say("preparation: lists in Python")
    lists = blender("receiver_lists.py", scene=LIVING_ROOM)
    with tempfile.TemporaryDirectory(dir=WORK) as folder:
        say("preparation: survey and planning")
        survey = survey_scene(Path(folder))
        planned = json.loads(run([PLANNING, Path(folder) / "survey.json", folder, 7])["output"])
    say("preparation: arrays of a real launch")
    arrays = blender_arrays()
    return {"lists": lists, "survey": survey, "planned": planned, "arrays": arrays}


def survey_scene(folder):
    """Survey as the product does it; the seconds are those of the whole launch, Blender's start included."""
    request = folder / "request.json"
    request.write_text(json.dumps({"scene": str(LIVING_ROOM), "allow_scripts": False, "nonce": "bench",
                                   "folder": str(folder)}), encoding="utf-8")
    cost = run([BLENDER, *HEADLESS, LIVING_ROOM, "--python", ROOT / "blender_scripts/survey_entry.py", "--", request])
    return {"wall": cost["wall"], "cpu": cost["cpu"]}


def blender_arrays():
    """Bakes one sample, keeps the launch's arrays and times the steps that make meshes of them."""
    with tempfile.TemporaryDirectory(dir=WORK) as folder:
        run([RNMBAKE, "bake", LIVING_ROOM, "-o", Path(folder) / "maps", "--resolution", 64, "--samples", 1,
             "--bounces", 0, "--save-scene", "never", "--keep-temporary"], {"TMPDIR": folder})
        launch, = {path.parent for path in Path(folder).rglob("receivers0.f32")}
        return blender("receiver_arrays.py", launch)


def report(data):
    lists, planned, arrays = data["lists"], data["planned"], data["arrays"]
    cpp = planned["steps"]
    per = {"lists": lists["triangles"] / 1e6, "planned": planned["triangles"] / 1e6,
           "arrays": arrays["triangles"] / 1e6}
    directions = sum(cpp[step] for step in ("tangent frames", "surface", "receiver passes", "crop", "group", "write arrays"))
    rows = [("evaluated meshes, with tangents, out of Blender", lists["steps"]["read"], cpp["read survey"], "planned",
             "the survey's `foreach_get`, read by C++; `inspect` and the choice of UVs need it anyway"),
            ("positions, basis normals, UVs of all corners", lists["steps"]["directions"], directions, "planned",
             "C++, from tangent frames to the file of arrays"),
            ("mesh and UVs", lists["steps"]["build"], arrays["steps"]["build"], "arrays", "`foreach_set`"),
            ("custom normals", lists["steps"]["normals"], arrays["steps"]["normals"], "arrays",
             "`normals_split_custom_set_from_vertices`, no corner shared")]
    lines = [[name, seconds(before), f"{before / per['lists']:.1f}", seconds(now), f"{now / per[count]:.2f}", how]
             for name, before, now, count, how in rows]
    before = sum(row[1] / per["lists"] for row in rows)
    after = sum(row[2] / per[row[3]] for row in rows)
    lines.append(["all", seconds(sum(row[1] for row in rows)), f"{before:.1f}", seconds(sum(row[2] for row in rows)),
                  f"{after:.2f}", f"{before / after:.0f} times faster for each triangle"])
    return "\n\n".join([
        table(["step", "lists, s", "s for each million", "arrays and C++, s", "s for each million", "how"], lines),
        f"Living room, flat and three bases: {lists['triangles']} receiver triangles with lists. The product has "
        f"{arrays['triangles']}, because triangles whose basis normals lie under their face are cut and get moment "
        "passes (`--horizon identity`), which the lists leave out. Lists: `bench/in_blender/receiver_lists.py`, the "
        "obvious script, nothing made slower on purpose.",
        "### The C++ part", cpp_table(cpp, planned["triangles"]), *changes_table()])


def changes_table():
    """Before and after of changes to the C++ part, from bench/compare_planning.py."""
    if not CHANGES.exists():
        return []
    lines = []
    for change in json.loads(CHANGES.read_text(encoding="utf-8")):
        before, after = change["before"], change["after"]
        for name, old, new, unit in (
                ("CPU", before["cpu"], after["cpu"], "s"),
                ("receiver passes", 1000 * before["steps"]["receiver passes"], 1000 * after["steps"]["receiver passes"], "ms"),
                ("write arrays", 1000 * before["steps"]["write arrays"], 1000 * after["steps"]["write arrays"], "ms"),
                ("receiver triangles", before["triangles"], after["triangles"], ""),
                ("peak", before["peak"] / 2**20, after["peak"] / 2**20, "MiB")):
            lines.append([change["what"], name, measure_of(old, unit), measure_of(new, unit)])
    return [table(["change", "of", "before", "after"], lines)
            + "\n\n`bench/compare_planning.py`: two builds of `bench_planning` taking turns."]


def measure_of(value, unit):
    return f"{value:.0f} {unit}".strip() if value >= 100 else f"{value:.2f} {unit}"


def cpp_table(steps, triangles):
    total = sum(seconds for step, seconds in steps.items() if step != NOT_A_BAKE)
    lines = [[step, f"{1000 * steps[step]:.0f}"] for step in sorted(steps, key=steps.get, reverse=True)]
    return table(["step", "ms"], lines) + (
        f"\n\n`bench_planning`, best of 7, {triangles} receiver triangles, one thread; {total:.2f} s without the UV "
        "report.")
