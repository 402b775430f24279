"""Self-shadowed bump maps: the horizon sweep beside a loop of Embree's rays, its error, sizes, instructions, the filter."""
import json
import os
from pathlib import Path

from measure import ROOT, run, say
from tables import seconds, table

TITLE = "Self-shadowed bump maps"
BENCH_SSBUMP = Path(os.environ.get("BENCH_SSBUMP", ROOT / "build/release/bench_ssbump"))


def measure(options):
    say("ssbump: sweep, rays, sizes")
    said = run([BENCH_SSBUMP, *(options.ssbump or "").split()])
    return {**json.loads(said["output"]), "others": said["others"]}


def report(data):
    return "\n\n".join([methods(data), goals(data), sides(data)])


def methods(data):
    sweep, loop = data["sweep"], data["loop"]
    mark = "" if loop["whole"] else " (e)"
    rows = [[f"horizon sweep, {sweep['azimuths']} azimuths", *times(sweep["time"]), *error(sweep["error"]),
             *error(sweep["error_to_horizons"])],
            [f"Embree, {loop['rays']} rays", *(one + mark for one in times(loop["time"])), *error(loop["error"]),
             *error(loop["error_of_own_surface"])]]
    text = (f"{data['side']} x {data['side']} texels, cobbles under fractal noise, heights over 32 texels, wrapped; "
            f"{data['threads']} threads; cores others used: {data['others']:.1f}. Errors over the three axes and straight up of "
            f"{data['samples']} texels, against {data['truth_rays']:,} rays into the bilinear surface, and against another truth: "
            "for the sweep 2,048 exact horizons of the same surface (the two truths are "
            f"{data['truths_differ']['rmse']:.5f} apart, RMS), for Embree as many rays into its own surface, two triangles for each patch "
            f"(which is {loop['surfaces_differ']['rmse']:.4f} from the bilinear one).\n\n" +
            table(["method", "wall s", "CPU s", "RMSE", "largest", "RMSE, other truth", "largest"], rows) +
            f"\n\nEmbree's loop: occlusion rays, Hammersley sets, squares of 16 x 16 texels with the same directions, packets of "
            f"{loop['packet']} (of one: {seconds(loop['by_ones']['cpu_seconds'])} s, of eight: "
            f"{seconds(loop['by_eights']['cpu_seconds'])} s of CPU for the whole map, both from a part of it), one static mesh built at high quality that "
            "goes on 256 texels past the borders. Building it "
            f"({seconds(loop['build_seconds'])} s) is not counted.")
    if mark:
        text += "\n\n(e) extrapolated from a 16th of the rows, spread evenly."
    return text


def times(one):
    return [f"{one['seconds']:.3f}", f"{one['cpu_seconds']:.3f}"]


def error(one):
    return [f"{one['rmse']:.5f}", f"{one['max']:.4f}"]


def goals(data):
    error = data["sweep"]["error"]
    small, large = data["sides"][0], data["sides"][-1]
    rows = [timed("Embree's time over the sweep's", "at least 40", lambda kind: data["loop"]["time"][kind] / data["sweep"]["time"][kind],
                  lambda value: value >= 40)]
    for name, words in (("AVX2", "AVX2"), ("SSE4", "SSE4")):
        if name in data["instructions"]:
            rows.append(timed(f"{words} over the best instructions", "at most 2.5", lambda kind, name=name: slower(data, name, kind),
                              lambda value: value <= 2.5))
    rows += [timed(f"bilateral filter, radius {data['filter']['radius']}, over filter and sweep", "at most 0.25",
                   lambda kind: share(data, kind), lambda value: value <= 0.25),
             timed(f"a texel of {large['side']} x {large['side']} over one of {small['side']} x {small['side']}", "about 1",
                   lambda kind: per_texel(large, kind) / per_texel(small, kind), lambda value: value <= 1.25),
             ["RMSE", "at most 0.001", f"{error['rmse']:.5f}", "", met(error["rmse"] <= 0.001)],
             ["largest error", "at most 0.01", f"{error['max']:.4f}", "", met(error["max"] <= 0.01)]]
    return table(["what", "goal", "wall", "CPU", "met (wall)"], rows)


def timed(what, goal, value, is_met):
    wall, cpu = value("seconds"), value("cpu_seconds")
    return [what, goal, f"{wall:.2f}", f"{cpu:.2f}", met(is_met(wall))]


def slower(data, name, kind):
    return data["instructions"][name][kind] / min(one[kind] for one in data["instructions"].values())


def share(data, kind):
    filtered = data["filter"]["time"][kind]
    return filtered / (filtered + data["sweep"]["time"][kind])


def met(is_met):
    return "yes" if is_met else "**no**"


def per_texel(row, kind):
    return row["time"][kind] / row["side"] ** 2


def sides(data):
    rows = [[f"{row['side']} x {row['side']}", *times(row["time"]),
             *(f"{1e9 * per_texel(row, kind):.0f}" for kind in ("seconds", "cpu_seconds"))] for row in data["sides"]]
    isa = [[name, *times(time)] for name, time in data["instructions"].items()]
    return (table(["texels", "sweep, wall s", "CPU s", "wall ns for a texel", "CPU ns"], rows) +
            "\n\n64 azimuths; stones and heights are of the same size in texels at every side.\n\n" +
            table([f"instructions, {data['side']} x {data['side']}", "sweep, wall s", "CPU s"], isa) +
            f"\n\nThe filter takes {data['filter']['time']['seconds']:.3f} s. Times are the best of seven where one is below two seconds.")
