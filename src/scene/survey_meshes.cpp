#include "scene/survey_meshes.h"

#include "base/error.h"
#include "base/text.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

namespace rnmbake {
namespace {

using nlohmann::json;
using Indices = std::vector<std::uint32_t>;

void check_below(const Indices& indices, std::size_t limit, const char* what, const Owner& owner) {
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= limit) {
      fail(ExitCode::invalid_input, "{}{} {} points to element {} of {}; validate the mesh in Blender",
           owner(), what, i, indices[i], limit);
    }
  }
}

void check_polygons(const Mesh& mesh, const Owner& owner) {
  for (std::size_t i = 0; i < mesh.polygon_start.size(); ++i) {
    const std::size_t end = std::size_t{mesh.polygon_start[i]} + mesh.polygon_size[i];
    if (mesh.polygon_size[i] < 3 || end > mesh.loop_vertex.size()) {
      fail(ExitCode::invalid_input, "{}face {} has a wrong corner range; validate the mesh in Blender",
           owner(), i);
    }
  }
}

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_positions(const Mesh& mesh, const Owner& owner) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3& p = mesh.positions[i];
    if (!finite(p)) {
      fail(ExitCode::invalid_input,
           "{}vertex {} is at ({}, {}, {}); delete it in Blender or mend the modifier that makes it", owner(),
           i, p.x, p.y, p.z);
    }
  }
}

void check_uvs(const UvLayer& layer, const Owner& owner) {
  for (std::size_t i = 0; i < layer.uv.size(); ++i) {
    if (!std::isfinite(layer.uv[i].x) || !std::isfinite(layer.uv[i].y)) {
      fail(ExitCode::invalid_input, "{}UV layer '{}': corner {} is at ({}, {}); unwrap it anew", owner(),
           layer.name, i, layer.uv[i].x, layer.uv[i].y);
    }
  }
}

/// Blender leaves a zero or NaN normal where all faces of a vertex are degenerate.
void mend_normals(Mesh& mesh) {
  for (std::size_t triangle = 0; triangle < mesh.triangles(); ++triangle) {
    const auto corner = [&](std::size_t i) -> const Vec3& {
      return mesh.positions[mesh.corner_vertex(3 * triangle + i)];
    };
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3& normal = mesh.loop_normal[mesh.triangle_loops[3 * triangle + i]];
      if (!finite(normal) || normal.length2() < 1e-12F) {
        normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
        normal = normal.length2() > 0 ? normal : Vec3(0, 0, 1);
      }
    }
  }
}

void clamp_slots(Indices& slots) {
  for (std::uint32_t& slot : slots) {
    slot = static_cast<std::int32_t>(slot) < 0 ? 0 : slot;  // as Cycles reads a negative index
  }
}

void check_mesh(const Mesh& mesh, const Owner& owner) {
  check_below(mesh.loop_vertex, mesh.positions.size(), "corner", owner);
  check_below(mesh.triangle_loops, mesh.loop_vertex.size(), "triangle corner", owner);
  check_below(mesh.triangle_polygon, mesh.polygon_start.size(), "triangle", owner);
  check_polygons(mesh, owner);
  check_positions(mesh, owner);
  for (const UvLayer& layer : mesh.uv_layers) {
    check_uvs(layer, owner);
  }
  const int layers = static_cast<int>(mesh.uv_layers.size());
  if (mesh.active_uv >= layers || mesh.render_uv >= layers) {
    fail(ExitCode::invalid_input, "{}the active UV layer is not one of its {}", owner(),
         counted(mesh.uv_layers.size(), "layer"));
  }
}

}  // namespace

Mesh read_mesh(const json& entry, Blob& data, const Owner& owner) {
  const std::size_t vertices = count_at(entry, "vertices"), loops = count_at(entry, "loops");
  const std::size_t polygons = count_at(entry, "polygons"), triangles = count_at(entry, "triangles");
  const auto indices = [&](const char* key, std::size_t count) {
    return data.cut<std::uint32_t>(entry, key, count, owner);
  };
  Mesh mesh;
  mesh.name = entry.at("name").get<std::string>();
  mesh.positions = data.cut<Vec3>(entry, "positions", vertices, owner);
  mesh.loop_vertex = indices("loop_vertex", loops);
  mesh.loop_normal = data.cut<Vec3>(entry, "loop_normal", loops, owner);
  mesh.triangle_polygon =
      indices("triangle_polygon", triangles);  // first: triples of it cannot overflow then
  mesh.triangle_loops = indices("triangle_loops", 3 * triangles);
  mesh.polygon_start = indices("polygon_start", polygons);
  mesh.polygon_size = indices("polygon_size", polygons);
  mesh.polygon_slot = indices("polygon_slot", polygons);
  for (const json& layer : entry.at("uv_layers"))
    mesh.uv_layers.push_back(
        {layer.at("name").get<std::string>(), data.cut<Vec2>(layer, "offset", loops, owner)});
  mesh.active_uv = index_at(entry, "active_uv");
  mesh.render_uv = index_at(entry, "render_uv");
  check_mesh(mesh, owner);
  clamp_slots(mesh.polygon_slot);
  mend_normals(mesh);
  return mesh;
}

}  // namespace rnmbake
