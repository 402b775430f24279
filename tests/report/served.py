"""Pages that need a server, and packages of npm, in headless Chromium."""
import functools
import http.server
import os
from pathlib import Path
import shutil
import subprocess
import sys
import threading
import unittest

import browser

THREE = "three@0.187.0"
ENGINES = {"threejs": (THREE,), "gltf": (THREE,), "playcanvas": ("playcanvas@2.23.3",), "babylon": ("@babylonjs/core@9.35.0", "@babylonjs/loaders@9.28.0")}


def skip(why):
    print(f"SKIPPED: {why}", file=sys.stderr)
    raise unittest.SkipTest(f"SKIPPED: {why}")


def node_modules(folder, *packages):
    """A node_modules folder with these packages ("three@0.187.0"): the one that RNMBAKE_NODE_MODULES names where it has them,
    else npm fetches them into the folder. SkipTest where that cannot be."""
    named = os.environ.get("RNMBAKE_NODE_MODULES")
    if named and all((Path(named) / package.rpartition("@")[0]).is_dir() for package in packages):
        return Path(named)
    if not shutil.which("npm"):
        skip(f"no npm to fetch {', '.join(packages)} with; install the package npm")
    # Two attempts of ten seconds for each of two files at most.
    outcome = subprocess.run(["npm", "install", "--no-audit", "--no-fund", "--ignore-scripts", "--fetch-retries=1",
                              "--fetch-timeout=10000", "--fetch-retry-mintimeout=500", "--fetch-retry-maxtimeout=1000",
                              "--legacy-peer-deps", *packages],
                             cwd=folder, timeout=120, capture_output=True, text=True)
    if outcome.returncode:
        skip(f"npm cannot fetch {', '.join(packages)}: {outcome.stderr.strip().splitlines()[-1:]}")
    return Path(folder) / "node_modules"


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


class Served(unittest.TestCase):
    """Pages of one folder."""

    HARMLESS = ("GPU stall", "software WebGL")  # what software rendering says of itself

    @classmethod
    def serve(cls, folder, width, height):
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(folder)))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        cls.addClassCleanup(server.server_close)
        cls.addClassCleanup(server.shutdown)
        cls.address = f"http://127.0.0.1:{server.server_port}/"
        cls.browser = browser.Browser(width, height)
        cls.addClassCleanup(cls.browser.close)

    def open(self, page):
        self.browser.problems.clear()
        self.browser.call("Page.navigate", url=self.address + page)
        self.browser.wait("document.documentElement?.dataset.ready === 'yes'")

    def problems(self):
        """But for requests to our own server."""
        return [one for one in self.browser.problems
                if not one.startswith(("request: " + self.address, "request: blob:"))
                and not any(word in one for word in self.HARMLESS)]
