"""How far a farm carries: plans of real and of many more objects, a queue of many nodes, and the merge at the end.

    python3 bench/scale.py

Writes the tables of docs/scale.md. Plans are real, of `hall` with 160 objects and of its batches again and again
(bench_farm_plan); the nodes are simulated with their tasks, and what the merge takes is measured on bakes of a few samples.
"""
import heapq
import json
import random
import shutil
import subprocess

import document
from measure import RNMBAKE, ROOT, WORK, hall, run, say
from tables import table

PAGE = ROOT / "docs/scale.md"
OBJECTS, RESOLUTION, SAMPLES, MINUTES = 160, 1024, 256, 15
NODES = (1, 10, 100, 1000)
JOB_START = 2.0     # seconds between the end of a job and the first of the next one's on the same node
SPREAD = 0.2        # of a task's true length about the predicted one, standard deviation
MERGED = {"objects": 10, "resolution": 256, "samples": (32, 256)}


def folder_bytes(folder):
    return sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())


def submit(scene, folder, resolution, samples):
    """A plan with its cost; its cache and output folder lie beside it."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return run([RNMBAKE, "submit", scene, "-o", folder / "out", "--plan", folder / "plan", "--cache", folder / "cache",
                "--cache-limit", 0, "--resolution", resolution, "--samples", samples, "--bounces", 0, "--save-scene", "never",
                "--task-minutes", MINUTES])


def repeated(plan, objects, minutes, folder):
    """Figures and tasks of a plan of so many objects."""
    shutil.rmtree(folder, ignore_errors=True)
    bench = RNMBAKE.parent / "bench_farm_plan"
    out = subprocess.run([bench, plan, str(objects), str(minutes), folder], check=True, capture_output=True, text=True).stdout
    figures = json.loads(out)
    figures["bytes"] = folder_bytes(folder)
    figures["lengths"] = [task["seconds"] for task in json.loads((folder / "plan.json").read_text(encoding="utf-8"))["tasks"]]
    return figures


def queue(lengths, nodes, lost=0):
    """Seconds until the last task has ended: each node takes the next task as soon as it is free. A node that is lost is so in
    the middle of its first task, which is run again by another one."""
    random.seed(1)
    true = [max(0.2, random.gauss(1, SPREAD)) * seconds for seconds in lengths]
    again = true[:lost]
    free = [0.0] * max(nodes - lost, 1)
    heapq.heapify(free)
    for seconds in true[lost:] + again:
        heapq.heappush(free, heapq.heappop(free) + JOB_START + seconds)
    return max(free), sum(true)


def merging(samples):
    """Cost of a merge, and the passes that it added up."""
    folder = WORK / "scale_merge"
    submit(hall(MERGED["objects"]), folder, MERGED["resolution"], samples)
    plan = json.loads((folder / "plan/plan.json").read_text(encoding="utf-8"))
    for number in range(len(plan["tasks"])):
        run([RNMBAKE, "task", "run", "--plan", folder / "plan", "--index", number])
    passes = folder_bytes(folder / "cache")
    cost = run([RNMBAKE, "task", "merge", "--plan", folder / "plan"])
    return {"seconds": cost["cpu"], "bytes": passes}


def measure_merge():
    few, many = (merging(samples) for samples in MERGED["samples"])
    each = (many["seconds"] - few["seconds"]) / (many["bytes"] - few["bytes"])
    rest = max(0.0, few["seconds"] - each * few["bytes"])
    texels = MERGED["objects"] * MERGED["resolution"] ** 2
    return {"seconds_per_gib": each * 2**30, "seconds_per_megatexel": rest / texels * 2**20, "few": few, "many": many}


def size(count):
    for unit, step in (("TiB", 2**40), ("GiB", 2**30), ("MiB", 2**20), ("KiB", 2**10)):
        if count >= step:
            return f"{count / step:.1f} {unit}"
    return f"{count} bytes"


def time(seconds):
    if seconds >= 48 * 3600:
        return f"{seconds / 86400:.1f} days"
    return f"{seconds / 3600:.1f} h" if seconds >= 5400 else f"{seconds / 60:.0f} min" if seconds >= 90 else f"{seconds:.1f} s"


def main():
    scene = hall(OBJECTS)
    folder = WORK / "scale"
    say("planning")
    cost = submit(scene, folder, RESOLUTION, SAMPLES)
    real = repeated(folder / "plan", OBJECTS, MINUTES, WORK / "scale_same")
    batches = json.loads((folder / "plan/plan.json").read_text(encoding="utf-8"))["batches"]
    texels = OBJECTS * 4 * RESOLUTION**2  # flat and three directions, whole rectangles
    each = texels / len(batches) * 16     # bytes of one pass of one batch
    plans = {OBJECTS: real}
    for objects in (1000, 10000):
        say(f"{objects} objects")
        plans[objects] = repeated(folder / "plan", objects, MINUTES, WORK / "scale_more")
    say("merging")
    merge = measure_merge()
    rows = []
    for objects, plan in plans.items():
        kept = plan["passes"] * each
        merged = kept / 2**30 * merge["seconds_per_gib"] + objects * RESOLUTION**2 / 2**20 * merge["seconds_per_megatexel"]
        plan.update(kept=kept, merged=merged)
        rows.append([f"{objects:,}", f"{plan['batches']:,}", f"{plan['passes']:,}", f"{plan['tasks']:,}",
                     f"{plan['imbalance']:.2f}", size(plan["bytes"]), f"{plan['cut_cpu'] + plan['write_cpu']:.1f} s",
                     f"{plan['read_cpu']:.2f} s", size(kept), time(merged)])
    text = (f"`rnmbake submit` of `hall` with {OBJECTS} objects at {RESOLUTION} x {RESOLUTION}, {SAMPLES} samples, four maps each: "
            f"{cost['cpu']:.0f} s of processor time, survey and Blender's start included, at most {size(cost['peak'])} of "
            f"memory; its own plan takes {size(folder_bytes(folder / 'plan'))} with the receivers, which the larger ones below, "
            "made of its batches again and again, lack.\n\n")
    text += table(["objects", "batches", "passes", "tasks", "longest over mean", "plan", "cut and written (CPU)",
                   "read by each task (CPU)", "passes in the cache", "merge"], rows) + "\n\n"
    text += (f"Merge: measured on {MERGED['objects']} objects of {MERGED['resolution']} x {MERGED['resolution']}, "
             f"{size(merge['few']['bytes'])} and {size(merge['many']['bytes'])} of passes in {merge['few']['seconds']:.1f} s and "
             f"{merge['many']['seconds']:.1f} s of processor time: {merge['seconds_per_gib']:.1f} s for each GiB and "
             f"{merge['seconds_per_megatexel']:.2f} s for each million texels of an object, on one machine.\n\n")
    rows = []
    plan = plans[10000]
    for nodes in NODES:
        last, work = queue(plan["lengths"], nodes)
        after, _ = queue(plan["lengths"], nodes, lost=nodes // 10)
        starts = len(plan["lengths"]) / last
        rows.append([f"{nodes:,}", time(last), f"{100 * work / nodes / last:.1f} %", f"{starts:.2g}", time(after),
                     f"{100 * plan['merged'] / (last + plan['merged']):.0f} %"])
    text += (f"The plan of 10,000 objects on simulated nodes: each takes the next task when it is free, {JOB_START:g} s after "
             f"the one before; tasks take what was predicted, give or take {100 * SPREAD:.0f} %.\n\n")
    text += table(["nodes of two cores", "all tasks", "nodes that work", "job starts a second", "a tenth of the nodes lost",
                   "merge's share of all"], rows) + "\n"
    document.renew(PAGE, text)
    for name in ("scale", "scale_same", "scale_more", "scale_merge"):
        shutil.rmtree(WORK / name, ignore_errors=True)


if __name__ == "__main__":
    main()
