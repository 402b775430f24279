"""Lightmaps as the benches read them: by oiiotool, which knows nothing of rnmbake."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "with_blender"))
from pictures import read_picture  # noqa: E402

MAPS = ("", "rnm0.", "rnm1.", "rnm2.")  # what their channels' names begin with


def covered_texels(file):
    """Channels of every covered texel, by name."""
    _, _, rows = read_picture(file)
    return [texel for row in rows for texel in row if texel["coverage"] > 0]
