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
    mark = "" if loop["rows_traced"] == data["side"] else " (e)"
    rows = [[f"horizon sweep, {data['azimuths']} azimuths", seconds(sweep["seconds"]), *error(sweep["error"]),
             *error(sweep["error_to_horizons"])],
            [f"Embree, {loop['rays']} rays", seconds(loop["seconds"]) + mark, *error(loop["error"]),
             *error(loop["error_of_own_surface"])]]
    text = (f"{data['side']} x {data['side']} texels, cobbles under fractal noise, heights over 32 texels, wrapped; "
            f"{data['threads']} threads; cores others used: {data['others']:.1f}. Errors over the three axes and straight up of "
            f"{data['samples']} texels, against {data['truth_rays']:,} rays into the bilinear surface, and against another truth: "
            "for the sweep 2,048 exact horizons of the same surface (the two truths are "
            f"{data['truths_differ']['rmse']:.5f} apart, RMS), for Embree as many rays into its own surface, two triangles for each patch "
            f"(which is {loop['surfaces_differ']['rmse']:.4f} from the bilinear one).\n\n" +
            table(["method", "s", "RMSE", "largest", "RMSE, other truth", "largest"], rows) +
            f"\n\nEmbree's loop: occlusion rays, Hammersley sets, squares of 16 x 16 texels with the same directions, packets of "
            f"{loop['packet']} (of one: {seconds(loop['seconds_by_ones'])} s, of eight: {seconds(loop['seconds_by_eights'])} s for the whole "
            "map, both from a part of it), one static mesh built at high quality that goes on 256 texels past the borders. Building it "
            f"({seconds(loop['build_seconds'])} s) is not counted.")
    if mark:
        text += f"\n\n(e) extrapolated from {loop['rows_traced']} rows of {data['side']}, spread evenly."
    return text


def error(one):
    return [f"{one['rmse']:.5f}", f"{one['max']:.4f}"]


def goals(data):
    sweep, isa, best = data["sweep"], data["instructions"], min(data["instructions"].values())
    portable = isa.get("avx2", isa["baseline"])
    filtered = data["filter"]["seconds"]
    share = filtered / (filtered + sweep["seconds"])
    small, large = data["sides"][0], data["sides"][-1]
    growth = per_texel(large) / per_texel(small)
    ratio = data["loop"]["seconds"] / sweep["seconds"]
    rows = [["Embree's time over the sweep's", "at least 40", f"{ratio:.1f}", met(ratio >= 40)],
            ["RMSE", "at most 0.001", f"{sweep['error']['rmse']:.5f}", met(sweep["error"]["rmse"] <= 0.001)],
            ["largest error", "at most 0.01", f"{sweep['error']['max']:.4f}", met(sweep["error"]["max"] <= 0.01)],
            ["AVX2, without AVX-512, over the best instructions", "at most 2.5", f"{portable / best:.2f}", met(portable / best <= 2.5)],
            ["SSE2 alone over the best instructions", "at most 2.5", f"{isa['baseline'] / best:.2f}", met(isa["baseline"] / best <= 2.5)],
            [f"bilateral filter, radius {data['filter']['radius']}, of both", "at most 25 %", f"{100 * share:.1f} %", met(share <= 0.25)],
            [f"time for a texel, {large['side']} x {large['side']} over {small['side']} x {small['side']}", "about 1", f"{growth:.2f}",
             met(0.75 <= growth <= 1.25)]]
    return table(["what", "goal", "measured", "met"], rows)


def met(is_met):
    return "yes" if is_met else "**no**"


def per_texel(row):
    return row["seconds"] / row["side"] ** 2


def sides(data):
    rows = [[f"{row['side']} x {row['side']}", f"{row['seconds']:.3f}", f"{1e9 * per_texel(row):.0f}"] for row in data["sides"]]
    isa = [[name, f"{value:.3f}"] for name, value in data["instructions"].items()]
    return (table(["texels", "sweep s", "ns for a texel"], rows) + "\n\nStones and heights are of the same size in texels at every side.\n\n" +
            table([f"instructions, {data['side']} x {data['side']}", "sweep s"], isa) +
            f"\n\nThe filter takes {data['filter']['seconds']:.3f} s. Times are the best of three where one is below four seconds.")
