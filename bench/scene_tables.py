"""The part of docs/accuracy.md about scenes, from the figures that are kept."""
from scene_figures import CHANCE, NEGLIGIBLE, distance, holds, holds_zero, known, pairs, residuals
from tables import table

CAUSES = ["tilt clamp", "bump shadowing", "self-reflection", "light from below", "no diffuse reflection",
          "non-Lambertian diffuse"]
LISTED = 6  # biases beyond chance of one scene, the farthest first

HEAD = """## Scenes

`./dev accuracy scenes` runs [`rnmbake validate`](validate.md) on each scene and keeps the figures in
`bench/results/scene_accuracy.json`. Everything is a share of the reference's mean over the same texels, with its 95 %
interval in brackets. Scenes of our own are in `scenes/`; cornell_box, living_room and staircase2 were made by others,
are not part of this repository and were not made for lightmaps."""

RECEIVER = f"""### receiver against the reference

Bakes with `--materials lambert`, the model of the reference. A pair is an object and one of its four maps; it holds
where the bias lies within its interval or is at most {100 * NEGLIGIBLE:g} % of the mean. Of true 95 % intervals about one in
twenty does not hold the truth, so the number of pairs that do not hold is to be read beside the one that chance makes of
an exact bake. RMSE is free of noise as far as two halves can tell; of the scene, flat."""

LIMITS = """What was looked into, with other seeds and more paths, Blender 3.4.1, `cornell`:

- `ball` was off for real, -0.7 % flat and -1.1 % rnm2, until the tracer learnt what 3.4 does to samples past the edge of a
  triangle ([reference.md](reference.md#footprint)): many of its triangles are narrower than a texel. Direct light alone, 32 x 32 texels,
  4096 paths: +0.02 % flat (-0.01 to +0.04) and +0.04 % rnm2 (+0.01 to +0.08) now; 4.3.2 the same.
- `left`, `floor` and `back` are not off: with other seeds none of their twelve pairs is outside its interval, and `left` with 2048 paths
  is off by +0.04 % in rnm0 (-0.40 to +0.48).
- The pillars and statues of `hall` have triangles smaller than a texel, too; nothing else was tried there. Intervals do not know of rare
  bright texels that a few paths did not find: they are too short where most of an object is dark.
- The walls of `living_room` reflect so much that a bake's 32 bounces lose light: against a reference without that limit `Mesh064`,
  `Mesh014` and `Mesh013` are off by -7.2 % (-9.8 to -4.7), -7.2 % (-12.3 to -2.1) and -6.9 % (-12.0 to -1.8), flat, 16 x 16 texels,
  2048 paths; with `--bounces 32` on both sides by -0.5 % (-2.2 to +1.2), -0.3 % (-2.8 to +2.3) and -0.1 % (-2.3 to +2.1). Its row is
  measured with that limit. The residual of the recipe's decomposition there is `Mesh001`, whose paint is pure red: Cycles bakes its green
  and blue light as bright as the red ([no-diffuse](reference.md#the-published-recipe-traced)), which the tracer did not yet do when the
  table was measured. Baked alone (32 x 32 texels, 64 samples, 12 bounces), its residual was +53.1 % (+30.5 to +76.2), flat, and is -2.0 % (-9.3 to
  +6.0) now."""

RECIPE = """### What flat-normal-map's error is made of

The mean error of the published recipe over the whole scene, taken apart ([how](validate.md#where-the-error-comes-from)).
The residual is what no named cause explains; its interval should hold 0.
Of large scenes the recipe bakes a part of the objects (`--decompose`)."""

MODEL = """### What the reference has no model for

The scene's own materials (glossy, glass and so on) in `receiver`, minus the same scene of plain diffuse ones. It is
light that the reference leaves out, not an error of either. `cornell_box` passes for plain diffuse although its lamp shines on one side only:
that difference is not in this table, but in the next section."""


def text(results, scenes):
    runs = [run for run in results["runs"] if "failed" not in run]
    sections = [HEAD, measured_when(runs, scenes), RECEIVER, receiver_table(runs), beyond(runs), LIMITS, RECIPE, recipe_table(runs),
                residual_words(runs), *model(runs), *picture(results["other_renderer"]), *failures(results["runs"])]
    return "\n\n".join(section for section in sections if section)


def measured_when(runs, scenes):
    """The days and machines, and what is missing."""
    seen = sorted({f"{run['date']}, {run['machine']}" for run in runs})
    missing = [f"`{one}`" for one in scenes if one not in {run["scene"] for run in runs}]
    return ((f"Measured on {'; '.join(seen)}." if seen else "") +
            (f" Not measured yet: {', '.join(missing)}." if missing else "")).strip()


def percent(estimate, digits=2):
    """value (low to high)"""
    if not known(estimate):
        return "-"
    value, low, high = (f"{100 * number:+.{digits}f}" for number in estimate)
    return f"{value} % ({low} to {high})"


def short(estimate):
    return f"{100 * estimate[0]:+.1f}" if estimate and known(estimate) else "-"


def receiver_table(runs):
    head = ["scene", "Blender", "texels, paths", "objects", "pairs that do not hold", "chance makes", "largest bias of a pair",
            "of the scene, flat", "its farthest basis", "RMSE"]
    return table(head, [receiver_row(run) for run in runs])


def receiver_row(run):
    all_pairs = list(pairs(run))
    flat = run["whole"]["flat"]
    largest = max(all_pairs, key=lambda pair: abs(pair[2][0]))
    farthest = max((row["bias"] for name, row in run["whole"].items() if name != "flat"), key=distance)
    return [run["scene"], run["blender"], f"{run['resolution']}, {run['samples']}", str(len(run["objects"])),
            f"{len(outside(run))} of {len(all_pairs)}", f"{chance(all_pairs):.1f}",
            f"{percent(largest[2])} `{largest[0]}` {largest[1]}", percent(flat["bias"]), percent(farthest),
            f"{100 * flat['rmse']:.1f} %"]


def chance(all_pairs):
    """Expected number of pairs that do not hold in an exact bake: one in twenty of intervals wider than NEGLIGIBLE."""
    return CHANCE * sum((bias[2] - bias[1]) / 2 > NEGLIGIBLE for _, _, bias in all_pairs)


def outside(run):
    missed = [pair for pair in pairs(run) if not holds(pair[2])]
    return sorted(missed, key=lambda pair: -distance(pair[2]))


def beyond(runs):
    """Pairs that do not hold, the farthest first."""
    lines = []
    for run in runs:
        listed = outside(run)
        words = ", ".join(f"`{one}` {basis} {percent(bias)}" for one, basis, bias in listed[:LISTED])
        more = f", and {len(listed) - LISTED} nearer ones" if len(listed) > LISTED else ""
        if listed:
            lines.append(f"- {run['scene']}, {run['blender']}: {words}{more}.")
    return "What does not hold, the farthest first (measured by its interval):\n\n" + "\n".join(lines) if lines else ""


def recipe_table(runs):
    head = ["scene", "Blender", "map", *CAUSES, "noise (RMSE)", "residual", "total"]
    rows = [[run["scene"], run["blender"], basis, *(short(parts.get(cause)) for cause in CAUSES),
             f"{100 * parts['noise']:.1f}", percent(parts["residual"]), short(parts["total"])]
            for run in runs for basis, parts in run["whole_recipe"].items()]
    return "In % of the mean; a dash where that Blender or scene has no such cause.\n\n" + table(head, rows)


def worst_residuals(run):
    """Objects with an unexplained residual, the farthest first."""
    missed = sorted((one for one in residuals(run) if not holds_zero(one[2])), key=lambda one: -distance(one[2]))
    words = ", ".join(f"`{name}` {basis} {percent(residual)}" for name, basis, residual in missed[:3])
    return f"- {run['scene']}, {run['blender']}: {words}" if missed else ""


def residual_words(runs):
    """How often the residual's interval holds 0, over scenes and over objects."""
    scenes = [parts["residual"] for run in runs for parts in run["whole_recipe"].values() if known(parts["residual"])]
    objects = [residual for run in runs for _, _, residual in residuals(run)]
    if not scenes:
        return ""
    return (f"The residual's interval holds 0 in {sum(map(holds_zero, scenes))} of these {len(scenes)} rows, and in "
            f"{sum(map(holds_zero, objects))} of {len(objects)} pairs of an object and a map;\nwere nothing unexplained, "
            f"chance would leave {(1 - CHANCE) * len(scenes):.0f} and {(1 - CHANCE) * len(objects):.0f}. The farthest three:\n\n" +
            "\n".join(filter(None, map(worst_residuals, runs))))


def model(runs):
    """A section if the materials of any scene are not plain diffuse."""
    rows = [[run["scene"], run["blender"], *(percent(parts.get("model difference", [None])) for parts in
                                             run["whole_recipe"].values()),
             f"{sum(bool(one['outside_model']) for one in run['objects'])} of {len(run['objects'])}"]
            for run in runs if any("model difference" in parts for parts in run["whole_recipe"].values())]
    return [MODEL, table(["scene", "Blender", "flat", "rnm0", "rnm1", "rnm2", "objects outside the model"], rows)] if rows else []


def picture(found):
    """Our tracer against a renderer that shares nothing with it or Cycles."""
    if not found:
        return []
    whole, shielded = found["as_it_is"], found["shielded"]
    return [f"""### Another renderer

cornell_box comes with a picture by the Tungsten renderer. Our tracer shows the same view (`rnmbake render` with
`--decode truth`, {found['side']} x {found['side']} pixels, {found['samples']} rays each, Blender {found['blender']}). With E = pi L / albedo on the
diffuse surfaces, and the same albedo on both sides, irradiances compare as the pixels do: ours / theirs, over
{shielded['pixels']:,} pixels and three colours. The goal is a median within 1 %.

The lamp's material makes it shine downwards only. In the [lambert scene](lambert.md) what glows glows on both sides, which lights
the ceiling from 2 cm below it: the first line is that model difference. The second has a black back on the lamp.""",
            table(["scene", "median", "red, green, blue", "90 % between", "mean over mean"],
                  [ratio_row("as it is", whole), ratio_row("lamp with a black back", shielded)])]


def ratio_row(title, ratios):
    return [title, f"**{ratios['median']:.4f}**", ", ".join(f"{value:.4f}" for value in ratios["medians"]),
            f"{ratios['p05']:.3f} and {ratios['p95']:.3f}", f"{ratios['mean']:.4f}"]


def failures(runs):
    """Scenes that ended with an error, in its words."""
    lines = [f"- {run['scene']}, {run['blender']}: {run['failed']}" for run in runs if "failed" in run]
    return ["### Not measured\n\n" + "\n".join(lines)] if lines else []
