"""KHR_lights_punctual: what a file leaves to defaults is written out, what Blender has no lamp for is left out."""
import math

from core.gltf_check import are_numbers
from core.gltf_file import BrokenGltf

LIGHT = "KHR_lights_punctual"
TYPES = ("point", "spot", "directional")
UNITS = {"point": "cd", "spot": "cd", "directional": "lx"}
LUMENS_PER_WATT = 683  # at 555 nm, as Blender's importer has it


def complete_lights(gltf):
    """Returns what the user should be warned of."""
    notes = []
    for number, light in enumerate(gltf.lights()):
        if light.get("type") not in TYPES:
            notes.append(f"lamp {name_of(light, number)}: glTF knows no type {light.get('type')!r}; it is left out")
            continue
        complete(light, number)
        if "range" in light:
            notes.append(f"lamp {name_of(light, number)}: its range of {light['range']:g} m is not followed; its light "
                         "ends nowhere, as Cycles has it")
    for node in gltf.items("nodes"):
        extensions = node.get("extensions", {})
        if LIGHT in extensions and gltf.lights()[extensions[LIGHT]["light"]].get("type") not in TYPES:
            del extensions[LIGHT]
    return notes


def name_of(light, number):
    return repr(light["name"]) if light.get("name") else str(number)


def complete(light, number):
    light.setdefault("intensity", 1.0)
    light.setdefault("color", [1.0, 1.0, 1.0])
    angles = [0.0, math.pi / 4]
    if light["type"] == "spot":
        spot = light.setdefault("spot", {})
        angles = [spot.setdefault("innerConeAngle", angles[0]), spot.setdefault("outerConeAngle", angles[1])]
    if not are_numbers([light["intensity"], light.get("range", 1.0), *angles], 4) or not are_numbers(light["color"], 3):
        raise BrokenGltf(f"lamp {name_of(light, number)}: its numbers are none; export it again")
