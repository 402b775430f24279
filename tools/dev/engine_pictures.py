"""Pictures for docs/engines/: the panels scene, delivered to engines of the web, as headless Chromium shows the page.

    python3 tools/dev/engine_pictures.py docs/images [threejs playcanvas babylon]

RNMBAKE_BINARY names another program than build/release/rnmbake, RNMBAKE_NODE_MODULES a node_modules folder with the packages of tests/report/served.py; without it npm fetches them.
"""
import os
from pathlib import Path
import subprocess
import sys
import tempfile

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "report"))
import served  # noqa: E402

WIDTH, HEIGHT = 960, 400


class Site(served.Served):
    """Pages of a folder, without tests."""


def deliver(*words):
    rnmbake = os.environ.get("RNMBAKE_BINARY", ROOT / "build" / "release" / "rnmbake")
    env = {name: value for name, value in os.environ.items() if name not in ("RNMBAKE_BINARY", "RNMBAKE_NODE_MODULES")}
    subprocess.run([rnmbake, "deliver", *map(str, words), "-q"], env=env, check=True)


def main():
    folder, *engines = sys.argv[1:]
    with tempfile.TemporaryDirectory(prefix="rnmbake-pictures-") as made:
        top = Path(made)
        modules = served.node_modules(top, *(package for packages in served.ENGINES.values() for package in packages))
        Site.serve(top, WIDTH, HEIGHT)
        try:
            for engine in engines or served.ENGINES:
                deliver(ROOT / "scenes" / "panels.toml", "--engine", engine, "-o", top / engine, "--lightmaps", top / "maps",
                        "--bake-engine", "embree", "--resolution", "128", "--samples", "64")
                (top / engine / "node_modules").symlink_to(modules)
                site = Site()
                site.browser.look_like(WIDTH, HEIGHT)
                site.open(f"{engine}/index.html")
                site.browser.run("document.querySelector('form').remove()")
                site.browser.screenshot(top / "seen.png", whole=False)
                for problem in site.problems():
                    print(f"engine_pictures.py: {engine}: {problem}", file=sys.stderr)
                subprocess.run(["oiiotool", "--nosoftwareattrib", top / "seen.png", "--ch", "R,G,B", "--eraseattrib", "Software|Exif:.*",
                                "--compression", "jpeg:92", "-o", Path(folder) / f"{engine}.jpg"], check=True)
        finally:
            Site.doClassCleanups()


if __name__ == "__main__":
    main()
