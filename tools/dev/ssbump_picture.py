"""The pictures of docs/ssbump.md: what a self-shadowed bump map is, and a plane under a moving light.

    ssbump_picture.py RNMBAKE FOLDER_FOR_FILES PICTURES_FOLDER
"""
import argparse
import base64
import math
from pathlib import Path
import random
import struct
import subprocess
import sys

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "report"))
import browser  # noqa: E402

SIZE = 256
STONES = 7  # along each side
FILES = ("height", "normal", "ssbump", "sharp", "bent", "flipped")


def stones():
    """Centres in texels, one in each cell of a grid, and how high each stone stands."""
    chance = random.Random(3)
    cell = SIZE / STONES
    return [((i + 0.5 + chance.uniform(-0.32, 0.32)) * cell, (j + 0.5 + chance.uniform(-0.32, 0.32)) * cell,
             chance.uniform(0.6, 1)) for i in range(STONES) for j in range(STONES)]


def height_at(x, y, centres):
    """Domes with gaps between them: the distance to the next stone's, tiled."""
    def distance(stone):
        dx, dy = abs(x - stone[0]), abs(y - stone[1])
        return math.hypot(min(dx, SIZE - dx), min(dy, SIZE - dy))
    near, second = sorted(centres, key=distance)[:2]
    gap = (distance(second) - distance(near)) * STONES / SIZE
    return near[2] * math.sqrt(1 - (1 - min(1, gap * 1.6)) ** 2)


def write_heights(file):
    """A 16-bit PGM."""
    centres = stones()
    values = (int(65535 * height_at(x + 0.5, y + 0.5, centres)) for y in range(SIZE) for x in range(SIZE))
    file.write_bytes(b"P5 %d %d 65535\n" % (SIZE, SIZE) + struct.pack(f">{SIZE * SIZE}H", *values))


def make_maps(rnmbake, folder):
    heights = folder / "stones.pgm"
    write_heights(heights)
    def run(*words):
        subprocess.run([rnmbake, "-q", "ssbump", *words], check=True)
    run(heights, "--height", "16", "--filter-radius", "0", "--alpha", "ao", "-o", folder / "ssbump.png",
        "--normal", folder / "normal.png", "--dump-height", folder / "height.png")
    run(heights, "--height", "16", "--filter-radius", "0", "--power", "4", "-o", folder / "sharp.png")
    run("flip", folder / "sharp.png", "-o", folder / "flipped.png")
    run("to-normal", folder / "ssbump.png", "-o", folder / "bent.png")


PAGE = """<!doctype html><meta charset="utf-8"><style>
body { margin: 12px; font: 15px sans-serif; background: #fff; color: #222; width: fit-content }
.row { display: flex; gap: 8px; margin-bottom: 12px }
figure { margin: 0 } figcaption { padding-top: 3px; width: 189px } canvas { display: block; width: 189px; height: 189px }
</style><body><script>
document.documentElement.dataset.ready = "yes";
const data = %s, size = %d;
const basis = [[Math.sqrt(2 / 3), 0, Math.sqrt(1 / 3)], [-Math.sqrt(1 / 6), Math.sqrt(1 / 2), Math.sqrt(1 / 3)],
               [-Math.sqrt(1 / 6), -Math.sqrt(1 / 2), Math.sqrt(1 / 3)]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const screen = linear => 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);
async function texels(name) {
  const bytes = Uint8Array.from(atob(data[name]), one => one.charCodeAt(0));
  const bitmap = await createImageBitmap(new Blob([bytes]), {premultiplyAlpha: "none", colorSpaceConversion: "none"});
  const canvas = new OffscreenCanvas(size, size), context = canvas.getContext("2d");
  context.drawImage(bitmap, 0, 0);
  return context.getImageData(0, 0, size, size).data;
}
// show(texel) gives the colour, 0 to 255; `row` takes the picture.
function figure(row, words, pixels, show) {
  const figure = row.appendChild(document.createElement("figure")), canvas = figure.appendChild(document.createElement("canvas"));
  figure.appendChild(document.createElement("figcaption")).textContent = words;
  canvas.width = canvas.height = size;
  const context = canvas.getContext("2d"), image = context.createImageData(size, size);
  for (let i = 0; i < size * size; ++i) {
    const colour = show([0, 1, 2, 3].map(c => pixels[4 * i + c] / 255));
    for (let c = 0; c < 3; ++c) image.data[4 * i + c] = colour[c];
    image.data[4 * i + 3] = 255;
  }
  context.putImageData(image, 0, 0);
}
const grey = value => [value, value, value];
const row = () => { const one = document.body.appendChild(document.createElement("div")); one.className = "row"; return one };
// The lamp goes round at 25 degrees of elevation; to its right at first.
const lamp = turn => { const high = 25 * Math.PI / 180, a = turn * Math.PI / 180;
                       return [Math.cos(high) * Math.cos(a), Math.cos(high) * Math.sin(a), Math.sin(high)] };
const lit_normal = l => t => grey(screen(Math.max(0, dot(l, [2 * t[0] - 1, 2 * t[1] - 1, 2 * t[2] - 1]))));
const lit_bump = l => t => grey(screen(Math.min(1, Math.max(0, Math.sqrt(3) * basis.reduce((sum, b, i) => sum + t[i] * dot(l, b), 0)))));
const pages = {
  maps: async () => {
    const [height, normal, ssbump, bent] = await Promise.all(["height", "normal", "ssbump", "bent"].map(texels));
    let line = row();
    figure(line, "height", height, t => grey(255 * t[0]));
    figure(line, "normal map", normal, t => t.map(c => 255 * c));
    figure(line, "bent normals", bent, t => t.map(c => 255 * c));
    figure(line, "ambient occlusion (alpha)", ssbump, t => grey(255 * t[3]));
    line = row();
    figure(line, "self-shadowed bump map", ssbump, t => t.map(c => Math.min(255, 2 * 255 * c)));
    for (const [c, words] of [[0, "from the right"], [1, "from the upper left"], [2, "from the lower left"]])
      figure(line, words, ssbump, t => grey(Math.min(255, 2 * 255 * t[c])));
  },
  light: async () => {
    const [normal, ssbump] = await Promise.all(["normal", "sharp"].map(texels));
    const turns = [0, 45, 90, 135, 180, 270];
    let line = row();
    for (const turn of turns) figure(line, turn ? `${turn}\\u00b0` : "normal map, 0\\u00b0", normal, lit_normal(lamp(turn)));
    line = row();
    for (const turn of turns) figure(line, turn ? `${turn}\\u00b0` : "self-shadowed, 0\\u00b0", ssbump, lit_bump(lamp(turn)));
  },
  handedness: async () => {
    const [ssbump, flipped] = await Promise.all(["sharp", "flipped"].map(texels));
    const line = row();
    for (const [name, pixels] of [["right", ssbump], ["wrong hand", flipped]])
      for (const [turn, from] of [[90, "above"], [270, "below"], [0, "the right"]])
        figure(line, `${name}: lamp from ${from}`, pixels, lit_bump(lamp(turn)));
  }};
async function draw(name) { document.body.querySelectorAll(".row").forEach(one => one.remove()); await pages[name](); }
</script>"""


def shoot(folder, pictures):
    maps = {name: base64.b64encode((folder / f"{name}.png").read_bytes()).decode() for name in FILES}
    page = folder / "page.html"
    page.write_text(PAGE % (maps, SIZE), encoding="utf-8")
    tab = browser.Browser()
    try:
        for name in ("maps", "light", "handedness"):
            tab.look_like(1200, 400, "light", False)
            tab.open(page)
            tab.run(f"draw({name!r})")
            size = [tab.run(f"document.body.getBoundingClientRect().{side} + 12 | 0") for side in ("right", "bottom")]
            tab.look_like(*size, "light", False)
            tab.screenshot(pictures / f"ssbump-{name}.png", whole=False)
    finally:
        tab.close()
    return tab.problems


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rnmbake", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("pictures", type=Path)
    args = parser.parse_args()
    if not browser.find():
        sys.exit("ssbump_picture.py: no Chromium; install the package chromium")
    args.folder.mkdir(parents=True, exist_ok=True)
    make_maps(args.rnmbake, args.folder)
    problems = shoot(args.folder, args.pictures)
    for problem in problems:
        print(f"ssbump_picture.py: {problem}", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
