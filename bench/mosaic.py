"""Pictures side by side, each under its words, as a browser sets them: oiiotool finds no letters on every machine."""
import html
from pathlib import Path
import subprocess
import sys

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "report"))
import browser  # noqa: E402


def write(figures, folder, columns, size, letters, quality, file):
    """Write a JPEG of `quality`. `figures`: words and a picture within `folder`, `size` (width, height) pixels each; `letters`: their
    height, pixels."""
    width, height = size
    line = letters + 7
    page = folder / "mosaic.html"
    parts = [f"<figure>{html.escape(words)}<img src='{picture.relative_to(folder)}'></figure>" for words, picture in figures]
    page.write_text(f"<!DOCTYPE html><meta charset='utf-8'><style>body {{ margin: 4px; display: grid; gap: 4px; font: {letters}px sans-serif; "
                    f"grid-template-columns: repeat({columns}, {width}px) }} figure {{ margin: 0 }} img {{ display: block }}</style>"
                    f"<html data-ready='yes'>{''.join(parts)}", encoding="utf-8")
    rows = -(-len(figures) // columns)
    tab = browser.Browser()
    try:
        tab.look_like(columns * (width + 4) + 4, rows * (height + line) + 4)
        tab.open(page)
        tab.wait("[...document.images].every(one => one.complete && one.naturalWidth > 0)")
        tab.screenshot(folder / "mosaic.png", whole=False)
    finally:
        tab.close()
    subprocess.run(["oiiotool", "--nosoftwareattrib", folder / "mosaic.png", "--ch", "R,G,B", "--eraseattrib", "Software|Exif:.*",
                    "--compression", f"jpeg:{quality}", "-o", file], check=True)
