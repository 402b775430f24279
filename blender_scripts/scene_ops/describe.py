"""What materials, lights and worlds are made of, and what in them a diffuse + emission tracer cannot follow."""
from scene_ops.describe_nodes import active_output, constant, is_zero, reachable_nodes, tree_source

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
    "LIGHT_PATH": "light path",
    "FRESNEL": "view-dependent",
    "LAYER_WEIGHT": "view-dependent",
    "CAMERA": "view-dependent",
    "AMBIENT_OCCLUSION": "ambient occlusion node",
    "BEVEL": "bevel node",
    "SCRIPT": "script node",
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
    for node in reachable_nodes(output.inputs["Surface"]):
        outside.update(outside_of(node))
        info["emissive"] |= emits(node)
        info["normal_mapped"] |= bends_normals(node)
    info["outside_model"] = sorted(outside)
    return info


def outside_of(node):
    if node.type == "BSDF_PRINCIPLED":
        yield from outside_of_principled(node)
    elif node.type == "BSDF_DIFFUSE":
        if not is_zero(node, "Roughness"):
            yield "rough diffuse"
    elif node.type in CLOSURES:
        yield CLOSURES[node.type]


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


def describe_light(ob, matrix):
    """LightInfo of scene/survey.h, and the size that the light's type has."""
    light = ob.data
    shape = {name: float(getattr(light, name)) for name in
             ("angle", "shadow_soft_size", "spot_size", "spot_blend", "size", "size_y") if hasattr(light, name)}
    return {
        "name": ob.original.name,
        "type": light.type,
        "energy": float(light.energy),
        "color": [float(value) for value in light.color],
        "shape": getattr(light, "shape", ""),
        "sizes": shape,
        "matrix": [value for row in matrix for value in row],
        "outside_model": sorted(set(outside_of_light(ob, light))),
    }


def outside_of_light(ob, light):
    if light.use_nodes and light.node_tree and not is_plain_light_tree(light.node_tree):
        yield "node tree"
    cycles = getattr(light, "cycles", None)
    if getattr(cycles, "is_portal", False):
        yield "portal"
    if not getattr(light, "use_shadow", True) or not getattr(cycles, "cast_shadow", True):
        yield "no shadow"
    if getattr(light, "use_temperature", False):
        yield "colour temperature"
    if getattr(light, "exposure", 0.0) != 0.0:
        yield "exposure"
    if not getattr(light, "normalize", True):
        yield "not normalized"
    linking = getattr(ob.original, "light_linking", None)
    if linking and (linking.receiver_collection or linking.blocker_collection):
        yield "light linking"


def is_plain_light_tree(tree):
    """The tree that Blender gives a light by itself: one white emission of strength 1."""
    emission = tree_source(tree, "OUTPUT_LIGHT")
    return (emission is not None and emission.type == "EMISSION" and constant(emission, "Strength") == 1.0
            and constant(emission, "Color") == (1.0, 1.0, 1.0))


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
