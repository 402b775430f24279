"""The benchmarks: `./dev bench [NAME...]` measures, keeps the figures and writes docs/performance.md.

Without a name: all of them. `./dev bench report` only writes the document, from the figures kept.
"""
import argparse
import json
import time
from pathlib import Path

import convert
import dense
import dispatch
import measure
import memory
import noop
import overhead
import preparation
import probes
import ssbump
import startup
import tracing

BENCHMARKS = {"dispatch": dispatch, "overhead": overhead, "dense": dense, "memory": memory, "preparation": preparation,
              "startup": startup, "noop": noop, "tracing": tracing, "ssbump": ssbump,
              "convert": convert, "probes": probes}
RESULTS = Path(__file__).resolve().parent / "results"
DOCUMENT = measure.ROOT / "docs/performance.md"
INTRODUCTION = """# Performance

Written by `./dev bench`, which measures everything below; do not edit. A single section: the command under its
title. The figures are kept in `bench/results/`, and `./dev bench report` writes this page from them.

"Wall" is a clock on the wall, "CPU" the processor time of rnmbake and every Blender it started. "Cores others used"
is what other work on the machine took meanwhile: well above 0 means that wall clocks are too long and the CPU column
is the one to read.
"""


def arguments():
    parser = argparse.ArgumentParser(prog="./dev bench", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join([*BENCHMARKS, "report"]))
    parser.add_argument("--full", action="store_true", help="dispatch: bake every object instead of extrapolating")
    parser.add_argument("--objects", type=int, nargs="+", help="dispatch: sizes of the hall (10 40 160)")
    parser.add_argument("--samples", type=int, nargs="+", help="overhead: samples (256)")
    parser.add_argument("--scenes", nargs="+", help="tracing: only these; the others' figures stay, if they are of this machine")
    parser.add_argument("--before", type=Path, metavar="BINARY", help="dense: an earlier rnmbake to compare with")
    parser.add_argument("--ssbump", metavar="FLAGS", help="ssbump: flags for bench_ssbump, such as '--side 256'")
    parser.add_argument("--patience", type=float, default=0, metavar="S",
                        help="wait so long for a quiet machine before each benchmark")
    options = parser.parse_args()
    unknown = set(options.names) - set(BENCHMARKS) - {"report"}
    if unknown:
        parser.error(f"no benchmark {sorted(unknown)[0]!r}; there are {', '.join([*BENCHMARKS, 'report'])}")
    return options


def kept(name):
    file = RESULTS / f"{name}.json"
    return json.loads(file.read_text(encoding="utf-8")) if file.exists() else None


def section(name):
    module, result = BENCHMARKS[name], kept(name)
    head = f"## {module.TITLE}\n\n`./dev bench {name}`"
    if result is None:
        return f"{head}: not measured yet."
    return f"{head}, {result['date']}, {result['machine']}.\n\n{module.report(result['data'])}"


def write_document():
    text = "\n".join([INTRODUCTION, *(section(name) + "\n" for name in BENCHMARKS)])
    DOCUMENT.write_text(text, encoding="utf-8")
    measure.say(f"wrote {DOCUMENT.relative_to(measure.ROOT)}")


def main():
    options = arguments()
    names = [name for name in options.names or BENCHMARKS if name != "report"]
    for name in names:
        measure.await_quiet(options.patience)
        data = BENCHMARKS[name].measure(options)
        result = {"date": time.strftime("%Y-%m-%d"), "machine": measure.machine(), "data": data}
        before = kept(name)
        if name == "tracing" and options.scenes and before and before["machine"] == result["machine"]:
            result = tracing.renewed(before, result)
        RESULTS.mkdir(exist_ok=True)
        (RESULTS / f"{name}.json").write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    write_document()


if __name__ == "__main__":
    main()
