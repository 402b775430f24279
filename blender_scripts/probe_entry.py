"""Blender runs this to tell the driver what it can do: compute devices, numpy, denoiser."""
import importlib.util
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from core.task import run  # noqa: E402


def main(_task):
    import _cycles
    return {
        "devices": sorted({device[1] for device in _cycles.available_devices("NONE")}),
        "numpy": importlib.util.find_spec("numpy") is not None,
        "denoiser": bool(getattr(_cycles, "with_openimagedenoise", False)),
    }


run(main)
