"""Self-shadowed bump maps against the truth: the tables of docs/ssbump-methods.md.

    ssbump_accuracy.py [--bench build/release/bench_ssbump_accuracy] [--heightmaps ../shared/heightmaps]
                       [--settings default,128/16] [--measured FILE]

Other arguments go on to the bench. --measured takes what an earlier run printed instead of measuring.
"""
import argparse
import json
import subprocess
from pathlib import Path

import document
from measure import ROOT

DOCUMENT = ROOT / "docs/ssbump-methods.md"
RMSE, LARGEST, FORM, SEAM = 1e-3, 1e-2, 1e-4, 1e-5  # asked for
BORDERS = {"wrap": "Wrapped", "none": "Borders that go on"}


def against(value, bound, digits):
    text = f"{value:.{digits}f}".removeprefix("0")
    return f"**{text}**" if value > bound else text


def power_of_ten(value, bound):
    text = "0" if value < 1e-7 else f"{value:.1e}".replace("e-0", "e-")
    return f"**{text}**" if value > bound else text


def errors(found, setting):
    text = f"{against(found['rmse'], RMSE, 4)}, {against(found['max'], LARGEST, 3)}"
    return f"{text} ({found['azimuths']})" if setting == "default" else text


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines) + "\n"


def titled(setting):
    return setting if setting == "default" else setting.replace("/", " / ")


class Figures:
    def __init__(self, rows):
        self.rows = rows
        self.settings = list(rows[-1]["settings"])

    def part(self, name):
        return [row for row in self.rows if row["part"] == name]

    def every(self, cell, row):
        return [cell(row["settings"][setting], setting) for setting in self.settings]

    def largest(self, row, bound):
        return self.every(lambda found, _: power_of_ten(found["max"], bound), row)

    def horizons(self, border):
        rows = [row for row in self.part("horizons") if row["border"] == border]
        if not rows:
            return ""
        factors = list(dict.fromkeys(row["factor"] for row in rows))
        head = ["map", *(f"{titled(setting)}, x{factor:g}" for setting in self.settings for factor in factors)]
        found = {(row["map"], row["factor"]): row["settings"] for row in rows}
        lines = [[name, *(errors(found[name, factor][setting], setting)
                          for setting in self.settings for factor in factors)]
                 for name in dict.fromkeys(row["map"] for row in rows)]
        return f"{BORDERS[border]}:\n\n" + table(head, lines)

    def rays(self):
        rows = self.part("rays")
        if not rows:
            return ""
        head = ["map (wrapped, x1)", "both truths apart", *map(titled, self.settings)]
        lines = [[row["map"], errors(row["truths_apart"], ""), *self.every(errors, row)] for row in rows]
        return "Against 65,536 rays into the surface, at the same texels:\n\n" + table(head, lines)

    def forms(self):
        rows = self.part("forms")
        if not rows:
            return ""
        head = ["closed form", "ambient", "exact horizons", *map(titled, rows[0]["settings"])]
        lines = [[row["map"], f"{row['ambient']:.4f}", power_of_ten(row["truth"]["max"], FORM),
                  *(power_of_ten(found["max"], FORM) for found in row["settings"].values())] for row in rows]
        return ("Largest error of a channel where weights are known in closed form; 1e-4 is asked for:\n\n" +
                table(head, lines))

    def seam(self):
        rows = self.part("seam")
        if not rows:
            return ""
        lines = [[row["map"], *self.largest(row, SEAM)] for row in rows]
        return ("Largest difference of a texel's weights after the map was moved by half its size along both axes; "
                "1e-5 is asked for:\n\n" + table(["map (wrapped, x1)", *map(titled, self.settings)], lines))

    def held(self):
        """In how many rows each setting is as exact as asked for."""
        rows = self.part("horizons")
        counts = []
        for setting in self.settings:
            found = [row["settings"][setting] for row in rows]
            good = sum(one["rmse"] <= RMSE and one["max"] <= LARGEST for one in found)
            counts.append(f"{titled(setting)} {good} of {len(found)}")
        return f"Cases that hold both bounds: {', '.join(counts)}.\n\n" if rows else ""

    def text(self):
        return "\n" + self.held() + "".join(map(self.horizons, BORDERS)) + self.rays() + self.forms() + self.seam()


def measured(description, bench):
    """The rows that a bench over height maps prints now, or printed once (--measured)."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bench", type=Path, default=ROOT / "build/release" / bench)
    parser.add_argument("--heightmaps", type=Path, default=ROOT / "../shared/heightmaps")
    parser.add_argument("--measured", type=Path)
    options, others = parser.parse_known_args()
    printed = options.measured.read_text(encoding="utf-8") if options.measured else run(options, others)
    return [json.loads(line) for line in printed.splitlines()]


def run(options, others):
    command = [options.bench, *others]
    if options.heightmaps.is_dir():
        command += ["--heightmaps", options.heightmaps]
    else:
        print(f"{options.heightmaps} IS NOT THERE: without the real maps")
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, encoding="utf-8").stdout


def main():
    document.renew(DOCUMENT, Figures(measured(__doc__, "bench_ssbump_accuracy")).text())


if __name__ == "__main__":
    main()
