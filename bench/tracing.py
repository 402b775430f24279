"""The reference tracer: time to the same noise as Cycles, its rays beside Embree's own, threads, memory."""
import json
import os
import tempfile
from pathlib import Path

from measure import LIVING_ROOM, RNMBAKE, ROOT, WORK, hall, run, say
from tables import mebibytes, seconds, table

TITLE = "The reference tracer"
BENCH_TRACING = Path(os.environ.get("BENCH_TRACING", ROOT / "build/release/bench_tracing"))
SIZE, BOUNCES = 64, 32


def scenes():
    built = ROOT / "scenes/built"
    found = [("cornell", built / "cornell.blend"), ("hall", hall(40)), ("cave", built / "cave.blend"),
             ("panels", built / "panels.blend"), ("living room", LIVING_ROOM)]
    for name, path in found:
        if path.exists():
            yield name, path
        else:
            say(f"tracing: {path} is not there, skipped")


def measure(options):
    rows = []
    with tempfile.TemporaryDirectory(dir=make(WORK)) as folder:
        for name, scene in scenes():
            if options.scenes and name not in options.scenes:
                continue
            exchange = Path(folder) / f"{name}.rnmscene"
            say(f"tracing: {name}")
            run([RNMBAKE, "export", scene, "-o", exchange, "--resolution", SIZE])
            rows.append({"scene": name, **race(scene, exchange, Path(folder)), **rays(exchange)})
    return {"rows": rows}


def renewed(before, result):
    """A result of some scenes, in their places among those of `before`, which each keep their date."""
    rows = {row["scene"]: {"date": one["date"], **row} for one in (before, result) for row in one["data"]["rows"]}
    return {**result, "data": {"rows": list(rows.values())}}


def make(folder):
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def race(scene, exchange, folder, samples=(128, 64)):
    """Noise and time of two halves of each; noise is what differs between the halves."""
    common = ["--resolution", SIZE, "--bounces", BOUNCES, "--depth", "float", "--save-scene", "never"]
    times, names = {}, {}
    for who, count in zip(("cycles", "ours"), samples):
        command = [RNMBAKE, "bake", scene, "--materials", "lambert"] if who == "cycles" else \
            [RNMBAKE, "reference", exchange]
        names[who] = [folder / f"{who}{half}" for half in (1, 2)]
        times[who] = 0
        for half, out in enumerate(names[who], 1):
            run([*command, "-o", out, *common, "--samples", count, "--seed", half])
            timings = json.loads((out / "timings.json").read_text(encoding="utf-8"))
            times[who] += timings["bake_seconds" if who == "cycles" else "wall_seconds"]
    said = run([RNMBAKE, "compare", names["cycles"][0], names["ours"][0], "--second-a", names["cycles"][1],
                "--second-b", names["ours"][1], "--json"])
    report = json.loads(said["output"][said["output"].index("{"):])
    return {"cycles_seconds": times["cycles"], "ours_seconds": times["ours"], "samples": samples,
            "bases": [basis_row(one) for one in report["scene"]],
            "typical": typical(report["objects"])}


def basis_row(metrics):
    return {"basis": metrics["basis"], "mean": metrics["reference_mean"], "bias": metrics["relative_bias"],
            "cycles": metrics["noise"]["candidate"], "ours": metrics["noise"]["reference"]}


def typical(objects):
    """Median over the objects of the ratio of squared noises, mean over the bases."""
    ratios = []
    for one in objects:
        squares = [(basis["noise"]["candidate"] ** 2, basis["noise"]["reference"] ** 2) for basis in one["bases"]]
        ours = sum(b for _, b in squares)
        if ours > 0:
            ratios.append(sum(a for a, _ in squares) / ours)
    return sorted(ratios)[len(ratios) // 2] if ratios else 0


def rays(exchange):
    result = {}
    for threads in (1, 2):
        said = run([BENCH_TRACING, exchange, "--size", SIZE, "--samples", 16, "--threads", threads, "--bare"])
        result[f"threads_{threads}"] = json.loads(said["output"])
    return result


def speed_up(row):
    """Cycles' time to the noise of ours, over ours: noise falls with the square root of time."""
    cycles = sum((one["cycles"] / one["mean"]) ** 2 for one in row["bases"]) * row["cycles_seconds"]
    ours = sum((one["ours"] / one["mean"]) ** 2 for one in row["bases"]) * row["ours_seconds"]
    return cycles / ours


def measured_on(rows):
    """Days of measurement by scene; "" where all are the same."""
    days = {}
    for row in rows:
        days.setdefault(row.get("date"), []).append(row["scene"])
    return "" if len(days) < 2 else "\n\nMeasured on " + "; ".join(f"{day}: {', '.join(of)}" for day, of in days.items()) + "."


def report(data):
    noise, tracer = [], []
    for row in data["rows"]:
        flat = row["bases"][0]
        bias = max(row["bases"], key=lambda one: abs(one["bias"]["value"]))["bias"]
        one, two = row["threads_1"], row["threads_2"]
        noise.append([row["scene"], seconds(row["cycles_seconds"]), f"{100 * flat['cycles'] / flat['mean']:.1f} %",
                      seconds(row["ours_seconds"]), f"{100 * flat['ours'] / flat['mean']:.1f} %",
                      f"**{speed_up(row):.1f}**", f"{row['typical'] * row['cycles_seconds'] / row['ours_seconds']:.1f}",
                      f"{100 * bias['value']:+.2f} % ({100 * bias['low95']:+.2f} to {100 * bias['high95']:+.2f})"])
        tracer.append([row["scene"], f"{one['triangles']:,}", f"{two['rays_per_second'] / 1e6:.1f}",
                       f"{100 * one['share_of_bare']:.0f} %", f"{100 * two['share_of_bare']:.0f} %",
                       f"{one['seconds'] / two['seconds']:.2f}",
                       mebibytes(two["bytes"] * 1e6 / max(1, two["triangles"])), f"{two['build_seconds']:.2f}"])
    return (table(["scene", "Cycles s", "its noise, flat", "reference s", "its noise, flat", "faster to the same noise",
                   "the median object", "largest bias of the two"], noise) +
            f"\n\nflat and three bases, {SIZE} x {SIZE} texels for each object, {BOUNCES} bounces, plain diffuse materials in both. "
            "Cycles' time is that within its joined bake call, the reference's all that follows reading the scene file. Noise is the "
            "RMS over all texels of half the difference of two bakes with different seeds; time to the same noise goes with its "
            "square, mean over the four maps. The goal is 10. `rnmbake bake --engine embree` traces the same way, so these are its "
            "times, too.\n\n" +
            table(["scene", "triangles", "Mrays/s, 2 threads", "of bare Embree, 1 thread", "2 threads", "2 threads are faster by",
                   "MiB for a million triangles", "build s"], tracer) +
            "\n\n\"Bare Embree\" asks rtcIntersect1 and rtcOccluded1 about a million of the same rays in the same order, and nothing else. "
            "The goal is 60 %." + measured_on(data["rows"]))
