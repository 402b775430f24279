#include "pipeline/deliver/engines/godot.h"

#include "base/error.h"
#include "image/layered_exr.h"
#include "pipeline/deliver/engine_axes.h"
#include "pipeline/deliver/engines/godot_names.h"
#include "pipeline/deliver/glb_nodes.h"

#include <algorithm>
#include <array>
#include <utility>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

using nlohmann::ordered_json;

constexpr int largest_picture = 16384;  // rows of what Godot's Image takes

constexpr const char* resource_name = "lightmaps.tres";

/// As Godot's own bake has its textures imported.
std::string page_import(std::size_t slices) {
  return fmt::format(
      "[remap]\n\nimporter=\"2d_array_texture\"\ntype=\"CompressedTexture2DArray\"\n\n[params]\n\n"
      "compress/mode=2\ncompress/channel_pack=1\nmipmaps/generate=false\nslices/horizontal=1\n"
      "slices/vertical={}\n",
      slices);
}

/// Light baking 1 keeps the second UV set; 2 would unwrap again. Suffixes such as -col in a name mean
/// nothing.
constexpr const char* scene_import =
    "[remap]\n\nimporter=\"scene\"\ntype=\"PackedScene\"\n\n[params]\n\nnodes/use_name_suffixes=false\n"
    "nodes/use_node_type_suffixes=false\nmeshes/light_baking=1\ngltf/naming_version=2\n";

constexpr const char* lit_scene =
    "[gd_scene load_steps=3 format=3]\n\n"
    "[ext_resource type=\"PackedScene\" path=\"scene.glb\" id=\"1\"]\n"
    "[ext_resource type=\"LightmapGIData\" path=\"lightmaps.tres\" id=\"2\"]\n\n"
    "[node name=\"Lightmapped\" type=\"Node3D\"]\n\n"
    "[node name=\"Scene\" parent=\".\" instance=ExtResource(\"1\")]\n\n"
    "[node name=\"LightmapGI\" type=\"LightmapGI\" parent=\".\"]\n"
    "light_data = ExtResource(\"2\")\n";

/// Godot shows a lightmap where its bounds are seen, and takes bounds only with a probe: one without light.
std::string probe_data(Imath::Box3d bounds) {
  const Vec3d margin = bounds.size() * 0.01 + Vec3d(0.01);
  bounds.min -= margin;
  bounds.max += margin;
  const Vec3d size = bounds.size(), centre = bounds.center();
  std::string light = "0, 0, 0, 1";
  for (int i = 1; i < 9; ++i) light += ", 0, 0, 0, 1";
  return fmt::format(
      "{{\n\"baked_exposure\": 1.0,\n\"bounds\": AABB({}, {}, {}, {}, {}, {}),\n\"bsp\": "
      "PackedInt32Array(),\n"
      "\"interior\": false,\n\"points\": PackedVector3Array({}, {}, {}),\n\"sh\": PackedColorArray({}),\n"
      "\"tetrahedra\": PackedInt32Array()\n}}",
      bounds.min.x, bounds.min.y, bounds.min.z, size.x, size.y, size.z, centre.x, centre.y, centre.z, light);
}

std::string lightmap_data(const GlbNodes& nodes, const ordered_json& record) {
  const GodotNames names(nodes);
  std::string text = fmt::format("[gd_resource type=\"LightmapGIData\" load_steps={} format=3]\n\n",
                                 record.at("pages").size() + 1);
  std::vector<std::string> textures, users;
  for (const ordered_json& page : record.at("pages")) {
    const std::string id = fmt::format("{}", textures.size() + 1);
    text += fmt::format("[ext_resource type=\"Texture2DArray\" path=\"{}\" id=\"{}\"]\n",
                        page.at("layers").begin().value().get<std::string>(), id);
    textures.push_back("ExtResource(\"" + id + "\")");
  }
  Imath::Box3d bounds;
  for (const ordered_json& object : record.at("objects")) {
    const auto node = object.at("node").get<std::size_t>();
    bounds.extendBy(nodes.bounds(node));
    users.push_back(fmt::format("NodePath(\"../Scene/{}\"), Rect2(0, 0, 1, 1), {}, -1", names.path(node),
                                object.at("page").get<std::size_t>()));
  }
  const bool is_directional = record.at("encoding") != EngineTarget::flat;
  return text + fmt::format(
                    "\n[resource]\nlightmap_textures = Array[TextureLayered]([{}])\n"
                    "uses_spherical_harmonics = {}\nuser_data = [{}]\nprobe_data = {}\n"
                    "_uses_packed_directional = {}\n",
                    fmt::join(textures, ", "), is_directional, fmt::join(users, ", "), probe_data(bounds),
                    is_directional);
}

/// One below the other.
FloatImage stacked(const std::vector<FloatImage>& slices) {
  FloatImage picture(slices[0].width(), slices[0].height() * static_cast<int>(slices.size()), 3);
  auto to = picture.data().begin();
  for (const FloatImage& slice : slices) to = std::ranges::copy(slice.data(), to).out;
  return picture;
}

}  // namespace

const std::vector<std::string>& Godot::encodings() const {
  static const std::vector<std::string> names{"sh2", flat};
  return names;
}

void Godot::pack(CodecOptions& codec) const {
  codec.range = 4;
}

ordered_json Godot::write_page(DeliveryFiles& files, std::size_t number, Page page) const {
  std::vector<FloatImage> slices{std::move(page.layers[0].pixels)};
  if (page.layers.size() > 1) {
    for (const EngineAxis& axis : {y_up_axes[1], y_up_axes[2], y_up_axes[0]}) {
      FloatImage& t = page.layers[1 + static_cast<std::size_t>(axis.blender)].pixels;
      slices.push_back(axis.reversed ? reversed_t(std::move(t)) : std::move(t));
    }
  }
  const int most = largest_picture / static_cast<int>(slices.size());
  if (slices[0].height() > most)
    fail(ExitCode::unsupported,
         "page {} has {} rows, and Godot takes {} at most, {} slices in a picture of {}; lower --pages",
         number, slices[0].height(), most, slices.size(), largest_picture);
  const std::string file = fmt::format("page{}.exr", number);
  write_exr(files.add(file), {{{"", {"R", "G", "B"}, stacked(slices)}}, {}}, Depth::half);
  files.add(file + ".import", page_import(slices.size()));
  ordered_json names = ordered_json::object();
  for (const char* slice : {"l0", "ty", "tz", "tx"}) {
    if (names.size() < slices.size()) names[slices.size() > 1 ? slice : flat] = file;
  }
  return names;
}

void Godot::add_files(DeliveryFiles& files, ordered_json& record) const {
  const GlbNodes nodes(files.made("scene.glb"));
  record["axes"] = "(x, z, -y) of Blender";
  files.add("scene.glb.import", scene_import);
  files.add(resource_name, lightmap_data(nodes, record));
  files.add("lightmapped.tscn", lit_scene);
}

}  // namespace rnmbake
