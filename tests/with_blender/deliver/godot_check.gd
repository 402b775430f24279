extends Node3D
# Stands in for the editor's importer: what it would make of the pages and the .glb takes their paths; the scene and the
# lightmap data are then loaded as they were delivered.

var kept := []

func _ready() -> void:
	var record: Dictionary = JSON.parse_string(FileAccess.get_file_as_string("res://lightmaps.json"))
	for index in record["pages"].size():
		_import_page(record, index)
	_import_scene("res://scene.glb")
	var lit: Node = load("res://lightmapped.tscn").instantiate()
	add_child(lit)
	var environment := Environment.new()
	environment.background_mode = Environment.BG_COLOR
	environment.background_color = Color.BLACK
	environment.ambient_light_source = Environment.AMBIENT_SOURCE_DISABLED
	environment.reflected_light_source = Environment.REFLECTION_SOURCE_DISABLED
	environment.tonemap_exposure = 0.125
	var world := WorldEnvironment.new()
	world.environment = environment
	add_child(world)
	var cameras := lit.find_children("*", "Camera3D", true, false)
	if cameras.size() > 0:
		cameras[0].make_current()
	for frame in 5:
		await RenderingServer.frame_post_draw
	var image := get_viewport().get_texture().get_image()
	image.convert(Image.FORMAT_RGB8)
	var said := {"users": _users(lit), "width": image.get_width(), "height": image.get_height(),
			"pixels": Marshalls.raw_to_base64(image.get_data()), "version": Engine.get_version_info()["string"]}
	JavaScriptBridge.eval("window.said = " + JSON.stringify(said) + "; document.documentElement.dataset.ready = 'yes'")

func _users(lit: Node) -> Array:
	var gi: LightmapGI = lit.get_node("LightmapGI")
	var data: LightmapGIData = gi.light_data
	var users := []
	for user in data.get_user_count():
		var node := gi.get_node_or_null(data.get_user_path(user))
		users.append([str(data.get_user_path(user)), node.get_class() if node else "none"])
	return users

func _import_page(record: Dictionary, index: int) -> void:
	var size: Dictionary = record["pages"][index]
	var halves := FileAccess.get_file_as_bytes("res://page%d.halves" % index)
	var slices: Array[Image] = []
	var bytes := int(size["width"]) * int(size["height"]) * 6
	for slice in 4:
		slices.append(Image.create_from_data(size["width"], size["height"], false, Image.FORMAT_RGBH,
				halves.slice(slice * bytes, (slice + 1) * bytes)))
	var array := Texture2DArray.new()
	array.create_from_images(slices)
	array.take_over_path("res://page%d.exr" % index)
	kept.append(array)

func _import_scene(path: String) -> void:
	var state := GLTFState.new()
	var document := GLTFDocument.new()
	document.append_from_file(path, state)
	var root := document.generate_scene(state)
	for node in root.find_children("*", "", true, false):
		node.owner = root
	var scene := PackedScene.new()
	scene.pack(root)
	scene.take_over_path(path)
	kept.append(scene)
