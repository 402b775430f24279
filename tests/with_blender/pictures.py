"""Pictures as oiiotool reads them, which knows nothing of rnmbake, and two of them side by side."""
from pathlib import Path
import subprocess

BLOCK = 10  # pixels along a side of what is compared: both ways of anti-aliasing agree over such


def read_picture(file):
    """Width, height, rows of pixels from the top, each a dict by channel; of 8 bits in [0, 1]."""
    largest = 255 if Path(file).suffix == ".png" else 1
    said = subprocess.run(["oiiotool", "--info", "-v", "--dumpdata", str(file)], capture_output=True, text=True, check=True).stdout
    channels, size, pixels = None, None, []
    for line in said.splitlines():
        if "channel list:" in line:
            channels = line.split(":", 1)[1].split(", ")
        elif "Pixel (" in line:
            numbers = line.split("):")[1].split("(")[0]  # what follows in brackets are the same, of 8 bits in [0, 1]
            values = [float(word) / largest for word in numbers.split()]
            pixels.append(dict(zip(map(str.strip, channels), values)))
        elif size is None and " x " in line and "channel" in line:
            words = line.split(" : ")[1].split(",")[0].split("x")
            size = int(words[0]), int(words[1])
    width, height = size
    assert len(pixels) == width * height, said
    return width, height, [pixels[y * width:(y + 1) * width] for y in range(height)]


def unlike_blocks(picture, light, black=0):
    """Blocks of the picture that see nothing but surfaces, compared with light(x, y), RGB: how many there are, and
    (left, top, ratio) of those whose means differ by more than 2 % and `black` of the picture's brightness."""
    width, height, rows = picture
    brightness = sum(pixel[channel] for row in rows for pixel in row for channel in "RGB") / (width * height)
    compared, off = 0, []
    for top in range(0, height - BLOCK + 1, BLOCK):
        for left in range(0, width - BLOCK + 1, BLOCK):
            block = [(left + x, top + y) for y in range(BLOCK) for x in range(BLOCK)]
            if not all(rows[y][x]["coverage"] == 1 for x, y in block):
                continue
            expected = sum(rows[y][x][channel] for x, y in block for channel in "RGB")
            seen = sum(sum(light(x, y)) for x, y in block)
            compared += 1
            if abs(seen - expected) > .02 * expected + black * brightness * len(block):
                off.append((left, top, seen / expected if expected else seen))
    return compared, off
