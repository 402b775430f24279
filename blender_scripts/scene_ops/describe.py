"""Contents of materials, lights and worlds, and those of their parts that a diffuse + emission tracer cannot follow."""
from scene_ops import light_paths
from scene_ops.describe_nodes import active_output, constant, is_zero, reachable_nodes, tree_source
from scene_ops.see_through import casts_opaque_shadow, has_transparency, lets_light_through

# Closures by node type. Diffuse, Principled and Emission are looked at more closely.
CLOSURES = {
    "BSDF_GLOSSY": "glossy",
    "BSDF_ANISOTROPIC": "glossy",
    "BSDF_METALLIC": "metallic",
    "BSDF_GLASS": "glass",
    "BSDF_REFRACTION": "transmission",
    "BSDF_TRANSPARENT": "transparent",
    "BSDF_TRANSLUCENT": "translucent",
    "BSDF_VELVET": "sheen",
    "BSDF_SHEEN": "sheen",
    "BSDF_TOON": "toon",
    "BSDF_HAIR": "hair",
    "BSDF_HAIR_PRINCIPLED": "hair",
    "SUBSURFACE_SCATTERING": "subsurface",
    "HOLDOUT": "holdout",
    "RAY_PORTAL_BSDF": "ray portal",
    "BSDF_RAY_PORTAL": "ray portal",
    "EEVEE_SPECULAR": "Eevee only",
    # Not closures, but a surface that asks these looks different from every side.
    "FRESNEL": "view-dependent",
    "LAYER_WEIGHT": "view-dependent",
    "CAMERA": "view-dependent",
    "AMBIENT_OCCLUSION": "ambient occlusion node",
    "BEVEL": "bevel node",
    "SCRIPT": "script node",
    "PARTICLE_INFO": "particle info",
}

ATTRIBUTES = {"VIEW_LAYER": "view layer attribute"}

# Outputs of nodes that have others too, which are the same from every side and for every instance.
OUTPUTS = {
    "NEW_GEOMETRY": {"Backfacing": "backfacing", "Incoming": "view-dependent"},
    "TEX_COORD": {"Camera": "view-dependent", "Window": "view-dependent", "Reflection": "view-dependent"},
}

# Principled sockets under their names in 3.x and 4.x. All of these are off at 0.
PRINCIPLED_WEIGHTS = {
    "metallic": ("Metallic",),
    "glossy": ("Specular", "Specular IOR Level"),
    "transmission": ("Transmission", "Transmission Weight"),
    "subsurface": ("Subsurface", "Subsurface Weight"),
    "sheen": ("Sheen", "Sheen Weight"),
    "coat": ("Clearcoat", "Coat Weight"),
    "rough diffuse": ("Diffuse Roughness",),
}


def describe_material(material):
    """MaterialInfo of scene/survey.h."""
    info = {"normal_mapped": False, "emissive": False, "outside_model": []}
    output = active_output(material)
    if output is None:
        return info
    outside = set()
    if output.inputs["Volume"].is_linked:
        outside.add("volume")
    if output.inputs["Displacement"].is_linked:
        outside.add("displacement")
    if light_paths.unsure(reachable_nodes(output.inputs["Surface"]), has_transparency(material)):
        outside.add("light path")
    for node in reachable_nodes(output.inputs["Surface"]):
        outside.update(outside_of(node))
        info["emissive"] |= emits(node)
        info["normal_mapped"] |= bends_normals(node)
    if lets_light_through(material):
        outside.discard("transparent")
        if casts_opaque_shadow(material):
            outside.add("opaque shadow")
    info["outside_model"] = sorted(outside)
    return info


def outside_of(node):
    if node.type == "BSDF_PRINCIPLED":
        yield from outside_of_principled(node)
    elif node.type == "BSDF_DIFFUSE":
        if not is_zero(node, "Roughness"):
            yield "rough diffuse"
    elif node.type in OUTPUTS:
        yield from (what for name, what in OUTPUTS[node.type].items() if node.outputs[name].is_linked)
    elif node.type in CLOSURES:
        yield CLOSURES[node.type]
    if node.type == "ATTRIBUTE" and node.attribute_type in ATTRIBUTES:
        yield ATTRIBUTES[node.attribute_type]


def outside_of_principled(node):
    for what, names in PRINCIPLED_WEIGHTS.items():
        if not is_zero(node, *names):
            yield what
    if constant(node, "Alpha") != 1.0:
        yield "transparent"
    if node.inputs.get("Subsurface Weight") is None:  # before 4.0
        yield "Disney diffuse"


def emits(node):
    if node.type == "EMISSION":
        return not is_zero(node, "Strength") and not is_zero(node, "Color")
    if node.type == "BSDF_PRINCIPLED":
        return not is_zero(node, "Emission Strength") and not is_zero(node, "Emission", "Emission Color")
    return False


def bends_normals(node):
    """A closure whose normal comes from a node: a normal map, bump, or anything else."""
    if not any(output.type == "SHADER" for output in node.outputs):
        return False
    return any(node.inputs.get(name) is not None and node.inputs[name].is_linked
               for name in ("Normal", "Clearcoat Normal", "Coat Normal"))


# Properties of a lamp's size, spread and unit of energy.
LIGHT_SIZES = ("angle", "shadow_soft_size", "spot_size", "spot_blend", "size", "size_y", "spread", "use_soft_falloff",
               "normalize")

NO_LIMIT = 1024  # Cycles' default and highest number of bounces


def describe_light(ob, matrix):
    """LightInfo of scene/survey.h, and the sizes that the light's type has.

    Energy and colour are what arrives: exposure, colour temperature and a plain emission node are in them.
    """
    light = ob.data
    energy, color = float(light.energy), [float(value) for value in light.color]
    energy *= 2.0 ** getattr(light, "exposure", 0.0)
    cycles = getattr(light, "cycles", None)
    if getattr(light, "use_temperature", False):
        color = [a * b for a, b in zip(color, light.temperature_color)]
    node = node_emission(light)
    if node:
        energy *= node[0]
        color = [a * b for a, b in zip(color, node[1])]
    return {
        "name": ob.original.name,
        "type": light.type,
        "energy": energy,
        "color": color,
        "shape": getattr(light, "shape", ""),
        "sizes": {name: float(getattr(light, name)) for name in LIGHT_SIZES if hasattr(light, name)},
        "matrix": [value for row in matrix for value in row],
        "max_bounces": getattr(cycles, "max_bounces", NO_LIMIT),
        "outside_model": sorted(set(outside_of_light(ob, light, matrix))),
    }


def outside_of_light(ob, light, matrix):
    if node_emission(light) is None:
        yield "node tree"
    cycles = getattr(light, "cycles", None)
    if not getattr(light, "use_shadow", True) or not getattr(cycles, "cast_shadow", True):
        yield "no shadow"
    linking = getattr(ob.original, "light_linking", None)
    if linking and (linking.receiver_collection or linking.blocker_collection):
        yield "light linking"
    if light.type in {"AREA", "SPOT"} and is_sheared(matrix):
        yield "sheared"


def is_sheared(matrix):
    """A scaled parent that is turned does it; Cycles then samples a shape that is not there."""
    axes = [matrix.to_3x3().col[i].normalized() for i in range(3)]
    return any(abs(axes[i].dot(axes[j])) > 1e-4 for i, j in ((0, 1), (1, 2), (2, 0)))


def node_emission(light):
    """Strength and colour of the one emission that a light's nodes are; None where they are anything more."""
    if not light.use_nodes or not light.node_tree:
        return 1.0, (1.0, 1.0, 1.0)
    emission = tree_source(light.node_tree, "OUTPUT_LIGHT")
    if emission is None or emission.type != "EMISSION":
        return None
    strength, color = constant(emission, "Strength"), constant(emission, "Color")
    return None if strength is None or color is None else (strength, color)


def describe_world(world):
    """World of scene/survey.h: its kind, strength and colour."""
    if world is None:
        return {"kind": "none", "strength": 0.0, "color": [0.0, 0.0, 0.0]}
    if not world.use_nodes or world.node_tree is None:
        return {"kind": "constant", "strength": 1.0, "color": [float(value) for value in world.color]}
    source = tree_source(world.node_tree, "OUTPUT_WORLD")
    if source is None:
        return {"kind": "none", "strength": 0.0, "color": [0.0, 0.0, 0.0]}
    strength, color = constant(source, "Strength"), constant(source, "Color")
    if source.type != "BACKGROUND" or strength is None:
        return {"kind": "nodes", "strength": strength or 0.0, "color": color or [1.0, 1.0, 1.0]}
    if color is not None:
        return {"kind": "constant", "strength": strength, "color": color}
    link = source.inputs["Color"].links[0]
    kind = "picture" if link.from_node.type == "TEX_ENVIRONMENT" else "nodes"
    return {"kind": kind, "strength": strength, "color": [1.0, 1.0, 1.0]}


def describe_probe_place(ob, matrix):
    """An empty, or one of Blender's volumes of light probes: the cube from -1 to 1 in its space. None for others.

    The volumes' type and the names of their counts changed with 4.1.
    """
    entry = {"name": ob.name, "matrix": [value for row in matrix for value in row], "counts": [0, 0, 0]}
    if ob.type == "EMPTY":
        return entry
    if ob.type != "LIGHT_PROBE" or ob.data.type not in ("GRID", "VOLUME"):
        return None
    prefix = "resolution_" if hasattr(ob.data, "resolution_x") else "grid_resolution_"
    entry["counts"] = [getattr(ob.data, prefix + axis) for axis in "xyz"]
    return entry
