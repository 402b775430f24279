"""Shows the lightmaps of lightmaps.json in Unreal 5, from within its editor.

Import scene.glb by File > Import Into Level, then run this file by Tools > Execute Python Script; after each delivery again.
It imports the pages, makes a material function that decodes them (MF_Light: light, E/pi, for a normal of a normal map) and
an unlit material for each of scene.glb's, and puts these on the actors that have the names of the lit objects.
"""
from collections import defaultdict
import json
from pathlib import Path
import re
import struct
import tempfile

import unreal

HERE = Path(__file__).resolve().parent
NEVER_NEGATIVE = ("flat", "rnm", "rnm-vrad", "rnm-bakery")  # what BC6H holds, which Unreal has without signs
GRAPH = unreal.MaterialEditingLibrary


def unreal_name(name):
    """With underscores for what names of Unreal's objects and packages cannot hold."""
    return re.sub(r"[\"' ,/.:|&!~\n\r\t@#(){}\[\]=;^%$`\\*?<>]", "_", name)


FOLDER = "/Game/Lightmaps/" + unreal_name(HERE.name)


class Glb:
    """The materials of a .glb, and the pictures within it."""

    def __init__(self, path):
        data = path.read_bytes()
        length = struct.unpack_from("<I", data, 12)[0]
        self.gltf = json.loads(data[20:20 + length])
        self.binary = data[28 + length:]

    def materials_of(self, node):
        """Number and name of each part of the node's mesh; (None, "") for a part without."""
        mesh = self.gltf["meshes"][self.gltf["nodes"][node]["mesh"]]
        numbers = [part.get("material") for part in mesh["primitives"]]
        return [(number, "" if number is None else self.gltf["materials"][number].get("name", "")) for number in numbers]

    def picture(self, texture):
        """Name, ending and bytes of a texture's picture."""
        image = self.gltf["images"][self.gltf["textures"][texture["index"]]["source"]]
        view = self.gltf["bufferViews"][image["bufferView"]]
        start = view.get("byteOffset", 0)
        ending = ".jpg" if image["mimeType"] == "image/jpeg" else ".png"
        return image.get("name", "picture"), ending, self.binary[start:start + view["byteLength"]]


def imported_texture(file, **settings):
    task = unreal.AssetImportTask()
    task.set_editor_properties({"filename": str(file), "destination_path": FOLDER, "automated": True, "replace_existing": True})
    unreal.AssetToolsHelpers.get_asset_tools().import_asset_tasks([task])
    textures = [made for made in task.get_objects() if isinstance(made, unreal.Texture2D)]
    if not textures:
        raise RuntimeError(f"Unreal has not imported {file}")
    textures[0].set_editor_properties(settings)
    return textures[0]


def asset(name, kind, factory):
    """The one of an earlier run, or a new one."""
    path = f"{FOLDER}/{name}"
    if unreal.EditorAssetLibrary.does_asset_exist(path):
        return unreal.EditorAssetLibrary.load_asset(path)
    return unreal.AssetToolsHelpers.get_asset_tools().create_asset(name, FOLDER, kind, factory)


class Nodes:
    """Makes the nodes of a material or a material function, from left to right."""

    def __init__(self, owner):
        self.owner, self.count = owner, 0
        self.is_function = isinstance(owner, unreal.MaterialFunction)
        if self.is_function:
            GRAPH.delete_all_material_expressions_in_function(owner)
        else:
            GRAPH.delete_all_material_expressions(owner)

    def add(self, kind, *inputs, **settings):
        """`inputs`: (node, name of its input that the node goes to); "" is the first."""
        create = GRAPH.create_material_expression_in_function if self.is_function else GRAPH.create_material_expression
        node = create(self.owner, kind, 250 * self.count - 2500, 0)
        self.count += 1
        node.set_editor_properties(settings)
        for source, name in inputs:
            if not GRAPH.connect_material_expressions(source, "", node, name):
                raise RuntimeError(f"Unreal does not connect '{name}' of a {kind.__name__}")
        return node

    def texture(self, name, texture, sampler, uv):
        return self.add(unreal.MaterialExpressionTextureSampleParameter2D, (uv, ""), parameter_name=name, texture=texture,
                        sampler_type=sampler)

    def vector(self, name, value):
        return self.add(unreal.MaterialExpressionVectorParameter, parameter_name=name, default_value=unreal.LinearColor(*value))

    def product(self, a, b):
        return self.add(unreal.MaterialExpressionMultiply, (a, "A"), (b, "B"))


def custom_input(name):
    made = unreal.CustomInput()
    made.set_editor_property("input_name", name)
    return made


def light_code(record, layers):
    """HLSL of the custom node. Unreal's normal maps have green down."""
    if record["encoding"] == "flat":
        return "return Flat;"
    flip = "float3(1.0, -1.0, 1.0)" if record["green"] == "y-up" else "float3(1.0, 1.0, 1.0)"
    decoder = record["decoder"]
    return (f"{decoder['text']}float3 n = normalize(N) * {flip};\n"
            f"return max(rnmbake.{decoder['function']}({', '.join(layers)}, n), 0.0);")


def light_function(record, first_page):
    """From a normal of a normal map as Unreal has it, in tangent space, to the page's light there."""
    function = asset("MF_Light", unreal.MaterialFunction, unreal.MaterialFunctionFactoryNew())
    nodes = Nodes(function)
    normal = nodes.add(unreal.MaterialExpressionFunctionInput, input_name="N",
                       input_type=unreal.FunctionInputType.FUNCTION_INPUT_VECTOR3)
    uv = nodes.add(unreal.MaterialExpressionTextureCoordinate, coordinate_index=record["texcoord"])
    samples = [(nodes.texture(layer, page, unreal.MaterialSamplerType.SAMPLERTYPE_LINEAR_COLOR, uv), layer)
               for layer, page in first_page.items()]
    light = nodes.add(unreal.MaterialExpressionCustom, description="rnmbake", code=light_code(record, list(first_page)),
                      output_type=unreal.CustomMaterialOutputType.CMOT_FLOAT3,
                      inputs=[custom_input(name) for name in ["N", *first_page]])
    for source, name in [(normal, "N"), *samples]:
        GRAPH.connect_material_expressions(source, "", light, name)
    nodes.add(unreal.MaterialExpressionFunctionOutput, (light, ""), output_name="Light")
    GRAPH.update_material_function(function)
    return function


class Materials:
    """An instance for each material of the .glb on a page, of few parents: one for those with the same kinds of textures."""

    def __init__(self, glb, record, folder):
        self.glb, self.folder, self.made, self.parents, self.textures = glb, folder, {}, {}, {}
        compressions = unreal.TextureCompressionSettings
        compression = compressions.TC_HDR_COMPRESSED if record["encoding"] in NEVER_NEGATIVE else compressions.TC_HDR
        self.pages = [{layer.capitalize(): imported_texture(
            HERE / file, compression_settings=compression, srgb=False,
            mip_gen_settings=unreal.TextureMipGenSettings.TMGS_NO_MIPMAPS,
            address_x=unreal.TextureAddress.TA_CLAMP, address_y=unreal.TextureAddress.TA_CLAMP)
            for layer, file in page["layers"].items()} for page in record["pages"]]
        self.light = light_function(record, self.pages[0])

    def instance(self, number, page):
        if (number, page) not in self.made:
            self.made[number, page] = self.make(number, page)
        return self.made[number, page]

    def make(self, number, page):
        material = self.glb.gltf["materials"][number]
        shading = material.get("pbrMetallicRoughness", {})
        maps = {"BaseColorMap": self.texture(shading.get("baseColorTexture"), srgb=True),
                "NormalMap": self.texture(material.get("normalTexture"), srgb=False, flip_green_channel=True,
                                          compression_settings=unreal.TextureCompressionSettings.TC_NORMALMAP)}
        maps = {name: texture for name, texture in maps.items() if texture}
        scale = material.get("normalTexture", {}).get("scale", 1)
        strength = material.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1)
        colours = {"BaseColor": shading.get("baseColorFactor", [1, 1, 1, 1]), "NormalScale": [scale, scale, 1, 1],
                   "Emission": [strength * part for part in material.get("emissiveFactor", [0, 0, 0])] + [1]}
        made = asset(f"MI_{unreal_name(material.get('name', 'material'))}_{number}_page{page}", unreal.MaterialInstanceConstant,
                     unreal.MaterialInstanceConstantFactoryNew())
        GRAPH.clear_all_material_instance_parameters(made)
        GRAPH.set_material_instance_parent(made, self.parent(maps))
        for name, texture in {**maps, **self.pages[page]}.items():
            GRAPH.set_material_instance_texture_parameter_value(made, name, texture)
        for name, colour in colours.items():
            GRAPH.set_material_instance_vector_parameter_value(made, name, unreal.LinearColor(*colour))
        GRAPH.update_material_instance(made)
        return made

    def texture(self, used, **settings):
        if used is None:
            return None
        name, ending, data = self.glb.picture(used)
        file = self.folder / f"T_{unreal_name(name)}_{used['index']}{'' if settings['srgb'] else '_data'}{ending}"
        if file not in self.textures:
            file.write_bytes(data)
            self.textures[file] = imported_texture(file, **settings)
        return self.textures[file]

    def parent(self, maps):
        """Base colour times light, and what glows. Its own textures are those of the first instance."""
        name = "_".join(["M_Lightmapped", *maps])
        if name in self.parents:
            return self.parents[name]
        made = asset(name, unreal.Material, unreal.MaterialFactoryNew())
        made.set_editor_properties({"shading_model": unreal.MaterialShadingModel.MSM_UNLIT, "two_sided": True})
        nodes = Nodes(made)
        uv = nodes.add(unreal.MaterialExpressionTextureCoordinate, coordinate_index=0)
        base = nodes.vector("BaseColor", [1, 1, 1, 1])
        if "BaseColorMap" in maps:
            base = nodes.product(base, nodes.texture("BaseColorMap", maps["BaseColorMap"],
                                                     unreal.MaterialSamplerType.SAMPLERTYPE_COLOR, uv))
        normal = nodes.add(unreal.MaterialExpressionConstant3Vector, constant=unreal.LinearColor(0, 0, 1, 1))
        if "NormalMap" in maps:
            normal = nodes.product(nodes.texture("NormalMap", maps["NormalMap"],
                                                 unreal.MaterialSamplerType.SAMPLERTYPE_NORMAL, uv),
                                   nodes.vector("NormalScale", [1, 1, 1, 1]))
        light = nodes.add(unreal.MaterialExpressionMaterialFunctionCall)
        light.set_material_function(self.light)
        GRAPH.connect_material_expressions(normal, "", light, "")
        leaves = nodes.add(unreal.MaterialExpressionAdd, (nodes.product(base, light), "A"),
                           (nodes.vector("Emission", [0, 0, 0, 1]), "B"))
        exposure = nodes.add(unreal.MaterialExpressionScalarParameter, parameter_name="Exposure", default_value=1.0)
        GRAPH.connect_material_property(nodes.product(leaves, exposure), "", unreal.MaterialProperty.MP_EMISSIVE_COLOR)
        GRAPH.recompile_material(made)
        self.parents[name] = made
        return made


def components_by_name():
    """Static meshes of the open level, by the names of their actors. Unreal's names know no case."""
    found = defaultdict(list)
    for actor in unreal.get_editor_subsystem(unreal.EditorActorSubsystem).get_all_level_actors():
        found[unreal_name(actor.get_actor_label()).lower()] += actor.get_components_by_class(unreal.StaticMeshComponent)
    return found


def keep_uvs(mesh):
    """The lightmap's UVs as they are in the .glb: none of Unreal's own in their place, and no half floats, which are
    coarser than the texels of large pages."""
    editor = unreal.get_editor_subsystem(unreal.StaticMeshEditorSubsystem)
    settings = editor.get_lod_build_settings(mesh, 0)
    settings.set_editor_properties({"generate_lightmap_u_vs": False, "use_full_precision_u_vs": True})
    editor.set_lod_build_settings(mesh, 0, settings)


def light(component, used, page, materials):
    """Slots have the names of materials; where they do not, their order."""
    keep_uvs(component.get_editor_property("static_mesh"))
    for place, (number, name) in enumerate(used):
        if number is not None:
            named = component.get_material_index(name)
            component.set_material(place if named < 0 else named, materials.instance(number, page))


def main():
    record = json.loads((HERE / "lightmaps.json").read_text(encoding="utf-8"))
    glb = Glb(HERE / record["scene"])
    components, missing = components_by_name(), []
    with tempfile.TemporaryDirectory() as folder:
        materials = Materials(glb, record, Path(folder))
        for lit in record["objects"]:
            found = components[unreal_name(lit["name"]).lower()]
            missing += [] if found else [lit["name"]]
            for component in found:
                light(component, glb.materials_of(lit["node"]), lit["page"], materials)
    unreal.EditorAssetLibrary.save_directory(FOLDER)
    for name in missing:
        unreal.log_warning(f"rnmbake: no actor in the open level is called '{name}'; use File > Import Into Level for scene.glb")
    unreal.log(f"rnmbake: {len(record['objects']) - len(missing)} of {len(record['objects'])} objects lit; materials in {FOLDER}")


main()
