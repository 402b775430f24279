"""As much of Unreal's Python as engines/unreal/rnmbake_unreal.py uses: names of classes, properties, methods and values are
those of Epic's documentation of the API (5.6), and every other one is refused. Nothing is drawn: what is made is kept to look at.
"""
from pathlib import Path
import types

_NODE = "MaterialExpression"
PROPERTIES = {
    "AssetImportTask": ["automated", "destination_path", "filename", "replace_existing"],
    "Texture2D": ["address_x", "address_y", "compression_settings", "flip_green_channel", "mip_gen_settings", "srgb"],
    "Material": ["shading_model", "two_sided"],
    "MaterialFunction": [],
    "MaterialInstanceConstant": [],
    "CustomInput": ["input_name"],
    "MeshBuildSettings": ["generate_lightmap_u_vs", "use_full_precision_u_vs"],
    "StaticMesh": [],
    "StaticMeshComponent": ["static_mesh"],
    "StaticMeshActor": [],
    _NODE + "Add": ["const_a", "const_b"],
    _NODE + "Constant3Vector": ["constant"],
    _NODE + "Custom": ["code", "description", "inputs", "output_type"],
    _NODE + "FunctionInput": ["input_name", "input_type"],
    _NODE + "FunctionOutput": ["output_name"],
    _NODE + "MaterialFunctionCall": ["material_function"],
    _NODE + "Multiply": ["const_a", "const_b"],
    _NODE + "ScalarParameter": ["default_value", "parameter_name"],
    _NODE + "TextureCoordinate": ["coordinate_index"],
    _NODE + "TextureSampleParameter2D": ["parameter_name", "sampler_type", "texture"],
    _NODE + "VectorParameter": ["default_value", "parameter_name"],
}
INPUTS = {_NODE + "Add": ["A", "B"], _NODE + "Multiply": ["A", "B"], _NODE + "FunctionOutput": [""],
          _NODE + "TextureSampleParameter2D": ["UVs"]}
VALUES = {
    "CustomMaterialOutputType": ["CMOT_FLOAT3"],
    "FunctionInputType": ["FUNCTION_INPUT_VECTOR3"],
    "MaterialProperty": ["MP_EMISSIVE_COLOR"],
    "MaterialSamplerType": ["SAMPLERTYPE_COLOR", "SAMPLERTYPE_LINEAR_COLOR", "SAMPLERTYPE_NORMAL"],
    "MaterialShadingModel": ["MSM_UNLIT"],
    "TextureAddress": ["TA_CLAMP"],
    "TextureCompressionSettings": ["TC_HDR", "TC_HDR_COMPRESSED", "TC_NORMALMAP"],
    "TextureMipGenSettings": ["TMGS_NO_MIPMAPS"],
}
FACTORIES = {"Material": "MaterialFactoryNew", "MaterialFunction": "MaterialFunctionFactoryNew",
             "MaterialInstanceConstant": "MaterialInstanceConstantFactoryNew"}


class Thing:
    """What has properties."""

    def __init__(self):
        self.values, self.links, self.nodes = {}, {}, []

    def set_editor_property(self, name, value):
        if name not in PROPERTIES[type(self).__name__]:
            raise AttributeError(f"{type(self).__name__} has no property '{name}'")
        self.values[name] = value

    def set_editor_properties(self, values):
        for name, value in values.items():
            self.set_editor_property(name, value)

    def get_editor_property(self, name):
        if name not in PROPERTIES[type(self).__name__]:
            raise AttributeError(f"{type(self).__name__} has no property '{name}'")
        return self.values[name]


class Editor:
    """An editor with an empty project; `module` is what `import unreal` finds in it. `actors`: (label, names of its slots)."""

    def __init__(self, actors):
        self.assets, self.files, self.said, self.warned, self.saved = {}, {}, [], [], []
        self.module = module = types.ModuleType("unreal")
        for name in PROPERTIES:
            setattr(module, name, type(name, (Thing,), {}))
        for name, values in VALUES.items():
            setattr(module, name, types.SimpleNamespace(**{value: value for value in values}))
        for name in FACTORIES.values():
            setattr(module, name, type(name, (), {}))
        module.LinearColor = lambda r, g, b, a: (r, g, b, a)
        module.log, module.log_warning = self.said.append, self.warned.append
        module.EditorActorSubsystem = types.SimpleNamespace(get_all_level_actors=lambda: self.actors)
        module.StaticMeshEditorSubsystem = types.SimpleNamespace(
            get_lod_build_settings=lambda mesh, lod: mesh.settings, set_lod_build_settings=self.set_lod_build_settings)
        module.get_editor_subsystem = lambda kind: kind
        module.AssetToolsHelpers = types.SimpleNamespace(get_asset_tools=lambda: types.SimpleNamespace(
            create_asset=self.create_asset, import_asset_tasks=self.import_asset_tasks))
        module.EditorAssetLibrary = types.SimpleNamespace(
            does_asset_exist=self.assets.__contains__, load_asset=self.assets.__getitem__, save_directory=self.saved.append)
        module.MaterialEditingLibrary = MaterialEditing()
        self.actors = [self.actor(*words) for words in actors]

    def actor(self, label, slots):
        mesh, component, actor = self.module.StaticMesh(), self.module.StaticMeshComponent(), self.module.StaticMeshActor()
        mesh.settings = self.module.MeshBuildSettings()
        component.values["static_mesh"], component.materials = mesh, {}
        component.get_material_index = lambda name: slots.index(name) if name in slots else -1
        component.set_material = component.materials.__setitem__
        actor.component = component
        actor.get_actor_label = lambda: label
        actor.get_components_by_class = lambda kind: [component] if isinstance(component, kind) else []
        return actor

    @staticmethod
    def set_lod_build_settings(mesh, lod, settings):
        mesh.built = {lod: dict(settings.values)}

    def create_asset(self, name, folder, kind, factory):
        if type(factory).__name__ != FACTORIES[kind.__name__]:
            raise TypeError(f"{type(factory).__name__} makes no {kind.__name__}")
        if f"{folder}/{name}" in self.assets or not folder.startswith("/Game/") or set(name) & set(". :/()"):
            raise ValueError(f"'{folder}/{name}' is taken, or no name of an asset")
        made = self.assets[f"{folder}/{name}"] = kind()
        return made

    def import_asset_tasks(self, tasks):
        """Names of textures are those of their files."""
        for task in tasks:
            file, folder = Path(task.values["filename"]), task.values["destination_path"]
            path = f"{folder}/{file.stem}"
            if set(file.stem) & set(". :/()") or (path in self.assets and not task.values["replace_existing"]):
                raise ValueError(f"'{path}' is taken, or no name of an asset")
            made = self.assets.setdefault(path, self.module.Texture2D())
            made.file, made.bytes = file, file.read_bytes()
            task.get_objects = lambda made=made: [made]


class MaterialEditing:
    def _create(self, owner, kind, x, y):
        node = kind()
        if kind.__name__ == _NODE + "MaterialFunctionCall":
            node.set_material_function = lambda function: node.values.update(material_function=function)
        owner.nodes.append(node)
        return node

    create_material_expression = create_material_expression_in_function = _create

    @staticmethod
    def _delete_all(owner):
        owner.nodes.clear()

    delete_all_material_expressions = delete_all_material_expressions_in_function = _delete_all

    @staticmethod
    def inputs(node):
        if "material_function" in node.values:
            return [inner.values["input_name"] for inner in node.values["material_function"].nodes
                    if type(inner).__name__ == _NODE + "FunctionInput"]
        if type(node).__name__ == _NODE + "Custom":
            return [one.values["input_name"] for one in node.values["inputs"]]
        return INPUTS.get(type(node).__name__, [])

    def connect_material_expressions(self, source, output, node, name):
        """Outputs: "", the first one. Inputs: by their names, or "", the first one."""
        inputs = self.inputs(node)
        if output or not inputs or (name and name not in inputs):
            return False
        node.links[name or inputs[0]] = source
        return True

    @staticmethod
    def connect_material_property(source, output, name):
        """Of the material that the node is in, which the API does not name either."""
        source.property = name
        return True

    @staticmethod
    def clear_all_material_instance_parameters(instance):
        instance.textures, instance.colours = {}, {}

    @staticmethod
    def set_material_instance_parent(instance, parent):
        instance.parent = parent

    @staticmethod
    def set_material_instance_texture_parameter_value(instance, name, texture):
        instance.textures[name] = texture
        return True

    @staticmethod
    def set_material_instance_vector_parameter_value(instance, name, colour):
        instance.colours[name] = colour
        return True

    @staticmethod
    def update_material_function(function):
        function.updated = True

    recompile_material = update_material_instance = update_material_function
