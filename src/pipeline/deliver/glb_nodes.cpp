#include "pipeline/deliver/glb_nodes.h"

#include "base/error.h"
#include "base/json.h"
#include "base/read_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include <ImathQuat.h>

namespace rnmbake {
namespace {

using nlohmann::json;

/// Khronos, "glTF 2.0 Specification", 4.4: a header of 12 bytes, then the chunk of JSON behind its length
/// and type.
json json_chunk(const std::filesystem::path& file) {
  constexpr std::size_t before = 20;
  const std::string head = read_part(file, 0, before);
  std::uint32_t length = 0;
  if (head.size() < before || !head.starts_with("glTF"))
    fail(ExitCode::invalid_input, "{} is no .glb", file.string());
  std::memcpy(&length, head.data() + 12, sizeof length);
  return parse_json(read_part(file, before, length), file.string());
}

template <std::size_t N>
std::array<double, N> numbers(const json& node, const char* name, const std::array<double, N>& otherwise) {
  return node.contains(name) ? node[name].get<std::array<double, N>>() : otherwise;
}

/// glTF's columns are the rows of Mat44.
Mat44 local_transform(const json& node) {
  if (node.contains("matrix")) {
    const auto given = node["matrix"].get<std::array<double, 16>>();
    Mat44 matrix;
    std::ranges::copy(given, matrix.getValue());
    return matrix;
  }
  const auto [sx, sy, sz] = numbers<3>(node, "scale", {1, 1, 1});
  const auto [qx, qy, qz, qw] = numbers<4>(node, "rotation", {0, 0, 0, 1});
  const auto [tx, ty, tz] = numbers<3>(node, "translation", {0, 0, 0});
  Mat44 scale, translation;
  scale.setScale(Vec3d(sx, sy, sz));
  translation.setTranslation(Vec3d(tx, ty, tz));
  return scale * Imath::Quatd(qw, qx, qy, qz).normalized().toMatrix44() * translation;
}

}  // namespace

GlbNodes::GlbNodes(const std::filesystem::path& file)
    : gltf_(json_chunk(file)), nodes_(gltf_.value("nodes", json::array())), parents_(nodes_.size(), -1) {
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    for (const json& child : nodes_[node].value("children", json::array()))
      parents_.at(child.get<std::size_t>()) = static_cast<int>(node);
  }
}

std::string GlbNodes::name(std::size_t node) const {
  return nodes_.at(node).value("name", "");
}

std::vector<std::size_t> GlbNodes::path(std::size_t node) const {
  std::vector<std::size_t> path{node};
  for (int parent = parents_.at(node); parent >= 0; parent = parents_.at(path.back()))
    path.push_back(static_cast<std::size_t>(parent));
  std::ranges::reverse(path);
  return path;
}

Mat44 GlbNodes::to_world(std::size_t node) const {
  Mat44 world;
  for (const std::size_t step : path(node)) world = local_transform(nodes_[step]) * world;
  return world;
}

Imath::Box3d GlbNodes::bounds(std::size_t node) const {
  Imath::Box3d box;
  if (!nodes_.at(node).contains("mesh")) return box;
  const Mat44 world = to_world(node);
  for (const json& primitive : gltf_["meshes"].at(nodes_[node]["mesh"].get<std::size_t>())["primitives"]) {
    const json& positions = gltf_["accessors"].at(primitive["attributes"]["POSITION"].get<std::size_t>());
    const std::array ends{positions["min"].get<std::array<double, 3>>(),
                          positions["max"].get<std::array<double, 3>>()};
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const Vec3d local(ends[corner & 1][0], ends[corner >> 1 & 1][1], ends[corner >> 2][2]);
      box.extendBy(local * world);
    }
  }
  return box;
}

std::string GlbNodes::scene_name() const {
  return gltf_["scenes"].at(gltf_.value("scene", std::size_t{0})).value("name", "");
}

std::vector<std::string> GlbNodes::mesh_names() const {
  std::vector<std::string> names;
  for (const json& mesh : gltf_.value("meshes", json::array())) names.push_back(mesh.value("name", ""));
  return names;
}

}  // namespace rnmbake
