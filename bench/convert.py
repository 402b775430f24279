"""Time and memory of `rnmbake convert` and `decode`, beside what reading and writing the same file costs."""
import tempfile
from pathlib import Path

from measure import RNMBAKE, ROOT, WORK, run, say
from tables import mebibytes, seconds, table

TITLE = "Converting and decoding lightmaps"
ENCODINGS = (("rnm", ()), ("sh2", ()), ("zh3", ()), ("geomerics", ()), ("ahd", ()), ("zh3", ("--range", 2, "--bits", 8)),
             ("geomerics", ("--range", 2, "--bits", 8)), ("zh3", ("--range", 2, "--bits", 8, "--mono")))
SIDE = 1024


def enlarged(lightmap, rows, folder):
    """The lightmap's header over SIDE columns and so many rows of its texels."""
    file = Path(folder) / f"rows_{rows}.exr"
    run(["oiiotool", lightmap, "--resize", f"{SIDE}x{rows}", "-d", "half", "--compression", "zip", "-o", file])
    return file


def costs(what, argv):
    say(f"convert: {what}")
    return {"what": what, **{key: value for key, value in run(argv).items() if key != "output"}}


def measure(options):
    del options
    WORK.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=WORK) as folder:
        truth = Path(folder) / "truth"
        run([RNMBAKE, "reference", ROOT / "scenes/built/cornell.blend", "--objects", "floor", "--resolution", 128,
             "--samples", 64, "-o", truth])
        whole, quarter = (enlarged(truth / "floor.exr", rows, folder) for rows in (SIDE, SIDE // 4))
        out = Path(folder) / "out"
        rows = [costs("read and write", ["oiiotool", whole, "-d", "half", "--compression", "zip",
                                         "-o", Path(folder) / "copy.exr"])]
        for name, flags in ENCODINGS:
            rows.append(costs(" ".join(["convert --to", name, *map(str, flags)]),
                              [RNMBAKE, "-q", "convert", whole, "--to", name, *flags, "-o", out]))
        rows.append(costs("a quarter of the rows: convert --to sh2",
                          [RNMBAKE, "-q", "convert", quarter, "--to", "sh2", "-o", out]))
        rows.append(costs("decode one normal", [RNMBAKE, "-q", "decode", whole, "--normal-vector", "0,0,1",
                                                "-o", Path(folder) / "lit.exr"]))
    return {"rows": rows}


def report(data):
    base = data["rows"][0]
    lines = [[row["what"], seconds(row["wall"]), seconds(row["cpu"]), f"{base['wall'] / row['wall']:.2f}",
              mebibytes(row["peak"])] for row in data["rows"]]
    return table(["what", "wall s", "CPU s", "speed beside read and write", "MiB"], lines) + (
        f"\n\n{SIDE} x {SIDE} texels, flat + 3 and coverage, half, zip; oiiotool reads and writes the same file. The goal is 0.8 "
        "for all. `convert` and `decode` of one normal work on 64 rows at a time, whatever the height. "
        "Refits (zh3, geomerics, packed forms) solve four equations for each colour of a texel, a vector's worth of colours side "
        "by side with the machine's widest instructions: Newton's steps, and damped Gauss-Newton ones for what a range does not "
        "hold; what Newton's do not solve goes on alone. A bound of the lobe over all normals that are asked spares most texels "
        "the search for negative values. Processor seconds of packed zh3 by instructions, once, beside 0.95 of reading and "
        "writing: AVX-512 1.4, AVX2 1.6, SSE4 2.0, SSE2 2.7; one after the other 3.9. Tried without gain: exponentials inlined "
        "into the steps instead of called.")
