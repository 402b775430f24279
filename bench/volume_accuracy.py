"""What light probes make of a statue and of walls, into docs/volumes.md: tables by bench_volumes, then the picture.

    volume_accuracy.py [--bench build/release/bench_volumes] [--samples 128] [--points 1000]
"""
import argparse
import json
import textwrap
from pathlib import Path

import document
import measure
import volume_views
from measure import RNMBAKE, ROOT, run

PAGE = ROOT / "docs" / "volumes.md"
WIDTH = 1.1  # of the statue, units
SPACINGS, LEAK_SPACINGS = (2, 1, 0.5), (1.3, 1, 0.5, 0.25)
# scene: bounds of the probes, places of the statue
STUDIES = {
    "hall": ("-5.2,0,0,5.2,12.8,4.6",
             ("0,2,1.1", "-4,4.8,1.1", "1.2,4.8,1.3", "4,6.4,1.1", "-1,8,1.1", "0.3,10.6,1.1")),
    "panels": ("-3.2,-0.6,0,3.2,5.2,3.2",
               ("0,0.5,1", "-1.6,1.1,1", "0.1,1.9,1", "2.4,1.9,1.1", "1.2,4.2,1.1", "-1.3,3.7,1.4")),
    "two_rooms": ("0,0,0,8.1,4,3",
                  ("1.7,2.9,1.1", "3.2,1.2,1.1", "4.05,2,1.1", "4.8,1.3,1.1", "5.6,2.4,1.1", "7.2,1.2,1.1"))}
COLOURS = {"cube": 6, "cube-fit": 6, "sh2": 4, "zh3": 4, "sh3": 9}
STATIC = "--no-lamps"
TESTS = ("none", "validity", "visibility")


# ---- measuring -----------------------------------------------------------------------------------


def exported(blend, out):
    run([RNMBAKE, "-q", "export", blend, "-o", out])
    return out


def with_statue(name, out):
    blend = (out / f"{name}.blend").resolve()
    measure.blender("add_statue.py", blend, WIDTH, 0, "0,0,1", "0,-2,1", scene=ROOT / "scenes" / "built" / f"{name}.blend")
    return exported(blend, out / f"{name}.rnmscene")


def statue(name, scene, args, *flags, spacings=SPACINGS):
    bounds, places = STUDIES[name]
    return json.loads(run([args.bench, "statue", "--scene", scene, f"--bounds={bounds}", *(f"--at={place}" for place in places),
                           "--spacing", ",".join(map(str, spacings)), "--points", args.points, "--samples", args.samples,
                           *flags])["output"])


def leaks(args):
    scene = exported(ROOT / "scenes" / "built" / "two_rooms.blend", args.out / "two_rooms_alone.rnmscene")
    return json.loads(run([args.bench, "leaks", "--two-rooms", scene, "--spacing", ",".join(map(str, LEAK_SPACINGS)), "--samples",
                           args.samples])["output"])


# ---- tables --------------------------------------------------------------------------------------


def rmse(figures):
    """In percent; a limit where it drowns in noise, two standard errors of its square."""
    square, noise = figures["rmse"] ** 2, 2 * figures["square_error"]
    return f"{100 * square ** 0.5:.1f}" if square > noise else f"< {100 * (square + noise) ** 0.5:.1f}"


def cell(figures):
    return f"{rmse(figures)} ({100 * figures['bias']:+.1f})"


def noise(studies):
    """The largest standard error of an RMSE that is above noise."""
    every = [row[key] for study in studies.values() for row in study["rows"] for key in ("own", "seen", "occluded") if key in row]
    return max(one["square_error"] / (2 * one["rmse"]) for one in every if one["rmse"] ** 2 > 2 * one["square_error"])


def find(study, spacing, encoding, test="visibility"):
    return next(row for row in study["rows"] if (row["spacing"], row["encoding"]) == (spacing, encoding)
                and row["test"] == (test if spacing else "none"))


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" + "|---:" * (len(head) - 1) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def encoding_table(study):
    probes = [find(study, spacing, "sh3")["probes"] for spacing in SPACINGS]
    head = ["kept of a probe", "colours", *(f"{s:g} apart, {n} probes" for s, n in zip(SPACINGS, probes)), "at the very place"]
    return table(head, [[f"`{name}`", str(colours), *(cell(find(study, s, name)["own"]) for s in (*SPACINGS, 0))]
                        for name, colours in COLOURS.items()])


def test_table(studies):
    head = ["leak test", *(f"{name}, {spacing:g}" for name in studies for spacing in SPACINGS)]
    return table(head, [[f"`{test}`", *(cell(find(study, s, "sh3", test)["own"]) for study in studies.values() for s in SPACINGS)]
                        for test in TESTS])


def seen_table(studies):
    rows = []
    for words, key in (("as it is", "seen"), ("times the statue's ambient occlusion", "occluded")):
        rows += [[f"`sh3` {s:g} apart, {words}", *(cell(find(study, s, "sh3")[key]) for study in studies.values())] for s in SPACINGS]
        rows.append([f"exact light without the statue's shadow, {words}", *(cell(study["floor"][key]) for study in studies.values())])
    return table(["what the statue is lit by", *studies], rows)


def percent(value):
    return f"{100 * value + 0.0:.2f}"


def leak_table(rows):
    cases = list(dict.fromkeys(row["case"] for row in rows))
    made = []
    for case in cases:
        for spacing in LEAK_SPACINGS:
            tests = {row["test"]: row for row in rows if (row["case"], row["spacing"]) == (case, spacing)}
            made.append([case, f"{spacing:g}", percent(tests["none"]["truth"]), *(percent(tests[test]["through"]) for test in TESTS),
                         percent(tests["visibility"]["excess"])])
    return table(["case", "spacing", "arrives there", *(f"through the wall, `{test}`" for test in TESTS),
                  "too much in all, `visibility`"], made)


# ---- sentences -----------------------------------------------------------------------------------


def listed(studies, figures):
    words = [f"{rmse(figures(study))} % in `{name}`" for name, study in studies.items()]
    return ", ".join(words[:-1]) + " and " + words[-1]


def findings(studies, sunlit, black, rows):
    def own(spacing, encoding, test="visibility"):
        return lambda study: find(study, spacing, encoding, test)["own"]

    def leak(case, spacing, test):
        return f"{percent(next(row['through'] for row in rows if (row['case'], row['spacing'], row['test']) == (case, spacing, test)))} %"

    quiet = max(abs(own(s, e, "visibility")(study)["rmse"] - own(s, e, "none")(study)["rmse"])
                for name, study in studies.items() if name != "two_rooms" for s in SPACINGS for e in COLOURS)
    sentences = [
        f"""**What to keep**: with probes 1 unit apart, about the width of the statue, `sh3` is off by
        {listed(studies, own(1, "sh3"))} (RMSE); `zh3`, with 4 colours in place of 9, by {listed(studies, own(1, "zh3"))};
        the ambient cube by {listed(studies, own(1, "cube"))}. What they lose even where a probe stands at the very place is
        {listed(studies, own(0, "sh3"))} for `sh3`, {listed(studies, own(0, "zh3"))} for `zh3`, {listed(studies, own(0, "cube"))} for
        the cube: more probes do not help below that.""",
        f"""**How dense**: at 2 units `sh3` is off by {listed(studies, own(2, "sh3"))}, at 0.5 by {listed(studies, own(0.5, "sh3"))},
        with about eight times the probes each time.""",
        f"""**The leak test**: where nothing leaks, in `hall` and `panels`, it changes the RMSE by {100 * quiet:.1f} points at most.
        Through a thin wall come {leak("thin wall", 1.3, "none")} of the bright side's light without it and
        {leak("thin wall", 1.3, "visibility")} with it (1.3 apart), {leak("thin wall", 1, "none")} and
        {leak("thin wall", 1, "visibility")} (1 apart). It cannot help a closed space in which no probe stands: in the cupboard
        {leak("cupboard", 1, "visibility")} remain at 1 unit, {leak("cupboard", 0.5, "visibility")} at 0.5.""",
        f"""**What probes cannot know**: of what is seen, exact light without the statue's own shadow is off by
        {listed(studies, lambda study: study["floor"]["seen"])}. Multiplied by the statue's ambient occlusion it is off by
        {listed(studies, lambda study: study["floor"]["occluded"])}: in `panels` worse than without, for the sun on the statue lights
        the statue again. A black one there is off by {rmse(black["floor"]["seen"])} %, multiplied by
        {rmse(black["floor"]["occluded"])} %.""",
        f"""**Lamps**: in `hall` with its sun in the probes, `sh3` 1 unit apart is off by {rmse(find(sunlit, 1, "sh3")["own"])} % in
        place of {rmse(own(1, "sh3")(studies["hall"]))} %: leave lamps to the engine (`--lights static`)."""]
    return "\n".join(bullet(" ".join(one.split())) for one in sentences)


def bullet(text):
    """Wrapped, but not between a number and its unit."""
    lines = textwrap.fill("- " + text.replace(" %", "~%"), 132, subsequent_indent="  ", break_on_hyphens=False, break_long_words=False)
    return lines.replace("~%", " %")


def page(studies, sunlit, black, rows):
    parts = ["\n## In short\n\n" + findings(studies, sunlit, black, rows)]
    parts.append("## What is kept of a probe\n\nRMSE (bias) of light without the statue's own shadow, in percent of the mean light on "
                 "the statue at each place, leak test `visibility`. *At the very place*: each point of the statue has a probe of its "
                 f"own. The truth's noise moves an RMSE by {100 * noise(studies):.1f} points at most (one standard error); what drowns in "
                 "it has a limit.")
    for name, study in studies.items():
        parts.append(f"`{name}`, {len(STUDIES[name][1])} places, {study['points']} points on the statue:\n\n" + encoding_table(study))
    parts.append("## What the leak test costs\n\nThe same of `sh3`, by scene and spacing:\n\n" + test_table(studies))
    parts.append("## What is seen\n\nThe same against the truth with the statue's own shadow and with the light that the statue sends to "
                 "itself, leak test `visibility`:\n\n" + seen_table(studies))
    parts.append("## Leaks\n\nIn percent of the light on the bright side, `sh3`, mean over places 10 cm and more from the walls and over "
                 "normals. *Through the wall*: what probes on its other side give. *Too much in all*: what is looked up less what "
                 "arrives, so light that smears over from before the door counts.\n\n" + leak_table(rows))
    return "\n\n".join(parts) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bench", type=Path, default=ROOT / "build/release/bench_volumes")
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "volumes")
    parser.add_argument("--points", default="1000", help="on the statue")
    parser.add_argument("--samples", default="128", help="of a point in each of eight batches of the truth, and of a probe's hemisphere")
    args = parser.parse_args()
    args.out = args.out.resolve()
    args.out.mkdir(parents=True, exist_ok=True)
    scenes = {name: with_statue(name, args.out) for name in STUDIES}
    studies = {name: statue(name, scene, args, STATIC) for name, scene in scenes.items()}
    sunlit = statue("hall", scenes["hall"], args, spacings=(1,))
    black = statue("panels", scenes["panels"], args, STATIC, "--black", spacings=(1,))
    rows = leaks(args)
    (args.out / "results.json").write_text(json.dumps({"studies": studies, "sunlit": sunlit, "black": black, "leaks": rows}), encoding="utf-8")
    document.renew(PAGE, page(studies, sunlit, black, rows))
    volume_views.write(ROOT / "out" / "volume-views", "192")


if __name__ == "__main__":
    main()
