"""Builds the scenes of this folder. Run by a headless Blender:

  blender -b --factory-startup -noaudio --python-exit-code 86 --python scenes/make.py -- COMMAND

  list                          every scene with its parameters and their defaults
  NAME OUTPUT.blend [key=value ...]   one scene
  all FOLDER                    every scene with its defaults, FOLDER/NAME.blend
"""

import inspect
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.dont_write_bytecode = True

import attic  # noqa: E402
import cave  # noqa: E402
import closed_forms  # noqa: E402
import cobbles  # noqa: E402
import cornell  # noqa: E402
import dungeon  # noqa: E402
import hall  # noqa: E402
import kit  # noqa: E402
import panels  # noqa: E402
import smooth  # noqa: E402
import suns  # noqa: E402
import two_rooms  # noqa: E402

SCENES = {
    "plane_sun": closed_forms.plane_sun,
    "plane_sky": closed_forms.plane_sky,
    "plane_lamp": closed_forms.plane_lamp,
    "furnace": closed_forms.furnace,
    "suns": suns.build,
    "smooth_box": smooth.box,
    "smooth_cylinder": smooth.cylinder,
    "cornell": cornell.build,
    "hall": hall.build,
    "cave": cave.build,
    "panels": panels.build,
    "cobbles": cobbles.build,
    "dungeon": dungeon.build,
    "two_rooms": two_rooms.build,
    "attic": attic.build,
}


def defaults(name):
    return {key: p.default for key, p in inspect.signature(SCENES[name]).parameters.items()}


def parse(name, settings):
    """key=value texts -> keyword arguments, each of its default's type."""
    known, given = defaults(name), {}
    for setting in settings:
        key, _, value = setting.partition("=")
        if key not in known:
            raise SystemExit(f"{name} has no parameter '{key}'; it takes: {', '.join(known) or 'none'}")
        try:
            given[key] = type(known[key])(value)
        except ValueError:
            raise SystemExit(f"{name}: '{value}' does not fit {key} (default {known[key]})") from None
    return given


def make(name, path, settings=()):
    if name not in SCENES:
        raise SystemExit(f"no scene '{name}'; there are: {', '.join(SCENES)}")
    arguments = parse(name, settings)
    SCENES[name](**arguments)
    path = os.path.abspath(path)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    kit.save(path)


def main(arguments):
    if arguments == ["list"]:
        for name in SCENES:
            print(name, *(f"{key}={value}" for key, value in defaults(name).items()))
    elif len(arguments) == 2 and arguments[0] == "all":
        for name in SCENES:
            make(name, os.path.join(arguments[1], name + ".blend"))
    elif len(arguments) >= 2:
        make(arguments[0], arguments[1], arguments[2:])
    else:
        raise SystemExit(__doc__)


main(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
