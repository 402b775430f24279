"""Time and memory of `rnmbake probes`, by Blender and by the reference, beside a launch of Blender for each face."""
import json
import random
import statistics
import tempfile
from pathlib import Path

from measure import BLENDER, RNMBAKE, ROOT, WORK, blender, run, say
from tables import mebibytes, seconds, table

TITLE = "Light probes"
COUNTS = (100, 1_000, 10_000)
SAMPLES = (16, 256)
FACES = 6  # of a probe where each is a bake of its own
REPEATS = 3
GOAL = 11  # times the light of ten times the probes
LOW, HIGH = (-1.4, 0.2, 0.1), (1.4, 2.2, 1.9)  # in the room of the scene
WRAPPER = """#!/usr/bin/env python3
import json, resource, subprocess, sys, time
start = time.monotonic()
code = subprocess.call([{blender!r}, *sys.argv[1:]], close_fds=False)
what = [word.rsplit("/", 1)[-1] for word in sys.argv if word.endswith("_entry.py")] or ["--version"]
used = resource.getrusage(resource.RUSAGE_CHILDREN)
with open({log!r}, "a", encoding="ascii") as log:
    log.write(json.dumps({{"what": what[0], "wall": time.monotonic() - start, "cpu": used.ru_utime + used.ru_stime,
                          "peak": 1024 * used.ru_maxrss}}) + "\\n")
sys.exit(code)
"""


def points(count, folder):
    """A list of places in the room, the same each time."""
    file, numbers = Path(folder) / f"points_{count}.csv", random.Random(count)
    rows = (",".join(f"{numbers.uniform(low, high):.4f}" for low, high in zip(LOW, HIGH)) for _ in range(count))
    file.write_text("\n".join(rows) + "\n", encoding="ascii")
    return file


def wrapper_in(folder):
    """A program that starts Blender and keeps what each start cost."""
    log, wrapper = Path(folder) / "starts", Path(folder) / "blender"
    wrapper.write_text(WRAPPER.format(blender=BLENDER, log=str(log)), encoding="utf-8")
    wrapper.chmod(0o755)
    return wrapper, log


def probes(scene, count, samples, folder, *flags):
    say(f"probes: {count} at {samples} samples, {' '.join(map(str, flags[:2])) or 'by the reference'}")
    cost = run([RNMBAKE, "-q", "probes", scene, "--points", points(count, folder), "--samples", samples, "--check", 0,
                "-o", Path(folder) / "out", *flags])
    del cost["output"]
    return {"probes": count, "samples": samples, **cost}


def by_blender(scene, count, samples, folder):
    wrapper, log = wrapper_in(folder)
    log.unlink(missing_ok=True)
    cost = probes(scene, count, samples, folder, "--by", "blender", "--blender", wrapper)
    starts = [json.loads(line) for line in log.read_text(encoding="ascii").splitlines()]
    bakes = [start for start in starts if start["what"] == "bake_entry.py"]
    return {**cost, "launches": len(bakes), "light": sum(start["wall"] for start in bakes),
            "light_cpu": sum(start["cpu"] for start in bakes), "blender_peak": max(start["peak"] for start in starts)}


def face(scene, samples):
    """Seconds of launches of Blender that bake one face each."""
    middle = [(low + high) / 2 for low, high in zip(LOW, HIGH)]
    costs = []
    for number in range(REPEATS):
        say(f"probes: one face at {samples} samples, {number + 1} of {REPEATS}")
        answer = blender("probe_face.py", *middle, samples, scene=scene)
        if not sum(answer["light"]) > 0:
            raise SystemExit("bench: the face of a probe is black")
        costs.append(answer["cost"])
    return {"samples": samples, "costs": costs}


def measure(options):
    del options
    WORK.mkdir(parents=True, exist_ok=True)
    scene = ROOT / "scenes/built/cornell.blend"
    with tempfile.TemporaryDirectory(dir=WORK) as folder:
        exported = Path(folder) / "cornell.rnmscene"
        run([RNMBAKE, "-q", "export", scene, "-o", exported])
        return {"faces": [face(scene, samples) for samples in SAMPLES],
                "blender": [by_blender(scene, count, samples, folder) for samples in SAMPLES for count in COUNTS],
                "reference": [probes(exported, count, samples, folder) for samples in SAMPLES for count in COUNTS]}


def row_of(rows, count, samples):
    return next(row for row in rows if (row["probes"], row["samples"]) == (count, samples))


def faces_table(data):
    """Ratios of processor time, too, which other work on the machine stretches less."""
    lines = []
    for one in data["faces"]:
        row, launches = row_of(data["blender"], COUNTS[0], one["samples"]), FACES * COUNTS[0]
        wall, cpu = (launches * statistics.mean(cost[what] for cost in one["costs"]) for what in ("wall", "cpu"))
        lines.append([str(one["samples"]), seconds(row["wall"]), seconds(row["light"]),
                      ", ".join(seconds(cost["wall"]) for cost in one["costs"]), f"{wall:.0f} (e)",
                      f"{wall / row['wall']:.0f} ({cpu / row['cpu']:.0f})", f"{wall / row['light']:.0f} ({cpu / row['light_cpu']:.0f})"])
    return table(["samples", "the command, wall s", "of it the launch that bakes, s", "a launch for one face, s",
                  f"{FACES * COUNTS[0]} launches, s", "x the command (of CPU)", "x the launch that bakes (of CPU)"], lines)


def growth(rows, row, what):
    """Times what a tenth of the probes takes; None where that was not measured."""
    if row["probes"] == COUNTS[0]:
        return None
    return row[what] / row_of(rows, row["probes"] // 10, row["samples"])[what]


def scale_table(data):
    lines = []
    for source, light in (("blender", "light"), ("reference", "wall")):
        light_cpu = "light_cpu" if source == "blender" else "cpu"
        for row in data[source]:
            times = [growth(data[source], row, what) for what in (light, light_cpu)]
            lines.append([f"`{source}`", str(row["samples"]), f"{row['probes']:,}", seconds(row["wall"]), seconds(row["cpu"]),
                          seconds(row[light]), f"{times[0]:.1f} ({times[1]:.1f})" if all(times) else "",
                          f"{1000 * row[light] / row['probes']:.2f}",
                          mebibytes(row["blender_peak"]) if source == "blender" else "", mebibytes(row["peak"]),
                          f"{row['others']:.1f}"])
    return table(["`--by`", "samples", "probes", "wall s", "CPU s", "light alone, s", "x a tenth of the probes (of CPU)", "ms a probe",
                  "peak MiB Blender", "peak MiB rnmbake", "cores others used"], lines)


def goal_line(data):
    rows = [row_of(data["blender"], COUNTS[-1], samples) for samples in SAMPLES]
    wall, cpu = (max(growth(data["blender"], row, what) for row in rows) for what in ("light", "light_cpu"))
    return (f"Ten times {COUNTS[-2]:,} probes should take Blender at most {GOAL} times as long: they take {wall:.1f} times, "
            f"{cpu:.1f} times the processor time{'' if wall <= GOAL else ', **which is more**'}.")


def report(data):
    return "\n\n".join([
        f"`cornell`, {COUNTS[0]} probes at random places in the room (`--points`), `--by blender`, `--check 0`, beside a launch "
        f"of Blender with a bake of its own for each of {FACES} faces of each probe:",
        faces_table(data),
        f"(e) extrapolated: {FACES * COUNTS[0]} times the mean of {REPEATS} launches of `bench/in_blender/probe_face.py`. The "
        "command bakes 14 directions for each probe, not 6; beside the launch that bakes it starts Blender to ask its version, to "
        "bake albedo and to write the scene down for the tracer, which looks for probes that stand in walls.",
        scale_table(data),
        "\"Light alone\" is the launch that bakes, or, by the reference, which is given a .rnmscene, all of the command. "
        + goal_line(data)])
