"""Materials, in the words that glTF has: one Principled BSDF. What has to stay as it is gets a note."""
from deliver import opacity, pictures
from deliver.front_values import front_value
from deliver.links import hand_over, source
from scene_ops.describe_nodes import active_output, find_input, is_zero
from scene_ops.plain_material import NO_MATERIAL, new_diffuse

# What the exporter follows.
FOLLOWED = {"colour": ("TEX_IMAGE", "RGB", "VERTEX_COLOR"), "opacity": ("TEX_IMAGE", "SEPRGB", "SEPARATE_COLOR"),
            "light's colour": ("TEX_IMAGE",), "light's strength": ()}


def settle(objects):
    """Of these objects, for this export alone. Returns the notes, one for each material."""
    bare = new_diffuse("no material", NO_MATERIAL)  # as Cycles shows it; glTF's own default is a white metal
    for ob in objects:
        if not ob.material_slots:
            ob.data.materials.append(bare)
        for slot in ob.material_slots:
            if slot.material is None:
                slot.material = bare
    used = {slot.material for ob in objects for slot in ob.material_slots}
    notes = [settle_one(material) for material in sorted(used, key=lambda material: material.name_full)]
    return [note for note in notes if note]


def have_normal_maps(objects):
    trees = [slot.material.node_tree for ob in objects for slot in ob.material_slots if slot.material.use_nodes]
    return any(node.type == "NORMAL_MAP" for tree in trees for node in tree.nodes)


def settle_one(material):
    """Returns what of the material is lost, in one line, or an empty text."""
    output = active_output(material)
    if output is None:
        return ""  # the exporter takes the viewport's colour, as Cycles does
    surface, mix = cut_out(source(output.inputs["Surface"]))
    if surface is not None and surface.type != "BSDF_PRINCIPLED":
        shaders = parts_of(surface)
        kinds = sorted(shader.type for shader in shaders)
        if kinds not in (["BSDF_DIFFUSE"], ["EMISSION"], ["BSDF_DIFFUSE", "EMISSION"]):
            words = ", ".join(sorted({shader.bl_label for shader in shaders}))
            return f"material '{material.name}' ({words}) has no counterpart in glTF; look at it in the engine"
        surface = make_principled(material, {shader.type: shader for shader in shaders})
    if surface is None:
        return ""
    material.node_tree.links.new(surface.outputs["BSDF"], output.inputs["Surface"])
    if mix is not None:
        opacity.take(material.node_tree, mix, surface.inputs["Alpha"])
    return lost(material, surface)


def cut_out(surface):
    """What is seen where nothing shines through, and the mixture with a Transparent BSDF that says where, or None."""
    if surface is None or surface.type != "MIX_SHADER":
        return surface, None
    factor, *sides = surface.inputs
    value, sides = front_value(factor), [source(side) for side in sides]
    if value in (0.0, 1.0):
        return cut_out(sides[int(value)])
    for side in (0, 1):
        if sides[side] is not None and sides[side].type == "BSDF_TRANSPARENT":
            return sides[1 - side], surface
    return surface, None


def parts_of(surface):
    """Shaders whose sum the surface is."""
    if surface.type != "ADD_SHADER":
        return [surface]
    return [part for socket in surface.inputs for side in [source(socket)] if side for part in parts_of(side)]


def make_principled(material, shaders):
    tree = material.node_tree
    principled = tree.nodes.new("ShaderNodeBsdfPrincipled")
    make_matt(principled)
    principled.inputs["Base Color"].default_value = (0, 0, 0, 1)
    if "BSDF_DIFFUSE" in shaders:
        hand_over(tree, shaders["BSDF_DIFFUSE"].inputs["Color"], principled.inputs["Base Color"])
        hand_over(tree, shaders["BSDF_DIFFUSE"].inputs["Normal"], principled.inputs["Normal"])
    if "EMISSION" in shaders:
        glow = find_input(principled, "Emission Color", "Emission")
        hand_over(tree, shaders["EMISSION"].inputs["Color"], glow)
        hand_over(tree, shaders["EMISSION"].inputs["Strength"], principled.inputs["Emission Strength"])
    return principled


def make_matt(principled):
    principled.inputs["Roughness"].default_value = 1
    find_input(principled, "Specular IOR Level", "Specular").default_value = 0


def lost(material, principled):
    """A note on what nodes make that glTF does not have; what they make the same everywhere is put in their place."""
    names = {"colour": ("Base Color",), "opacity": ("Alpha",)}
    if not is_zero(principled, "Emission Strength") and not is_zero(principled, "Emission Color", "Emission"):
        names |= {"light's colour": ("Emission Color", "Emission"), "light's strength": ("Emission Strength",)}
    made_by = {}
    for what, sockets in names.items():
        socket = find_input(principled, *sockets)
        node = source(socket)
        if node is None or node.type in FOLLOWED[what]:
            continue
        value = front_value(socket)
        if value is None:
            made_by[what] = node.bl_label
        else:
            set_constant(material.node_tree, socket, value)
    for what in names:
        if what.endswith("colour"):
            pictures.settle_color(material.node_tree, find_input(principled, *names[what]))
    opacity.show_through(material, principled)
    if made_by:
        told = " and ".join(f"its {what} comes out of the node '{label}'" for what, label in made_by.items())
        return f"material '{material.name}': {told}, which glTF does not have; bake it into a picture"
    return ""


def set_constant(tree, socket, value):
    tree.links.remove(socket.links[0])
    if isinstance(value, tuple):
        socket.default_value = (*value, 1.0)
    elif socket.type == "RGBA":
        socket.default_value = (value, value, value, 1.0)
    else:
        socket.default_value = value
