"""Materials, in the words that glTF has: one Principled BSDF. What has to stay as it is gets a note."""
from scene_ops.describe_nodes import active_output, find_input
from scene_ops.plain_material import NO_MATERIAL, new_diffuse

COLOR_NODES = ("TEX_IMAGE", "RGB", "VERTEX_COLOR")


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
    surface = source(output.inputs["Surface"])
    if surface is None or surface.type == "BSDF_PRINCIPLED":
        return lost_color(material, surface)
    shaders = parts_of(surface)
    kinds = sorted(shader.type for shader in shaders)
    if kinds not in (["BSDF_DIFFUSE"], ["EMISSION"], ["BSDF_DIFFUSE", "EMISSION"]):
        words = ", ".join(sorted({shader.bl_label for shader in shaders}))
        return f"material '{material.name}' ({words}) has no counterpart in glTF; look at it in the engine"
    principled = make_principled(material, {shader.type: shader for shader in shaders}, output)
    return lost_color(material, principled)


def source(socket):
    """The node behind a socket; reroutes are passed."""
    while socket.is_linked:
        node = socket.links[0].from_node
        if node.type != "REROUTE":
            return node
        socket = node.inputs[0]
    return None


def parts_of(surface):
    """Shaders whose sum the surface is."""
    if surface.type != "ADD_SHADER":
        return [surface]
    return [part for socket in surface.inputs for side in [source(socket)] if side for part in parts_of(side)]


def make_principled(material, shaders, output):
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
    tree.links.new(principled.outputs["BSDF"], output.inputs["Surface"])
    return principled


def make_matt(principled):
    principled.inputs["Roughness"].default_value = 1
    find_input(principled, "Specular IOR Level", "Specular").default_value = 0


def hand_over(tree, given, taken):
    if given.is_linked:
        tree.links.new(given.links[0].from_socket, taken)
    elif hasattr(given, "default_value") and given.name != "Normal":
        taken.default_value = given.default_value


def lost_color(material, principled):
    """A note where the colour is made by nodes that glTF does not have."""
    if principled is None:
        return ""
    node = source(principled.inputs["Base Color"])
    if node is None or node.type in COLOR_NODES:
        return ""
    return (f"material '{material.name}': its colour comes out of the node '{node.bl_label}', which glTF does not have; "
            "bake it into a picture")
