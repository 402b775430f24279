#include "bake/targets.h"

#include "base/error.h"
#include "scene/flat_triangle.h"
#include "scene/loose_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>

namespace rnmbake {
namespace {

std::optional<int> layer_named(const Mesh& mesh, std::string_view name) {
  for (std::size_t i = 0; i < mesh.uv_layers.size(); ++i) {
    if (mesh.uv_layers[i].name == name) return static_cast<int>(i);
  }
  return std::nullopt;
}

std::string layer_names(const Mesh& mesh) {
  std::string names;
  for (const UvLayer& layer : mesh.uv_layers) names += (names.empty() ? "'" : ", '") + layer.name + "'";
  return names.empty() ? "none" : names;
}

double uv_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return 0.5 * std::abs(double(b.x - a.x) * (c.y - a.y) - double(c.x - a.x) * (b.y - a.y));
}

double world_area(const Mesh& mesh, std::uint32_t triangle, const Mat44& to_world) {
  std::array<Vec3d, 3> p;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = Vec3d(mesh.positions[mesh.corner_vertex(3 * std::size_t(triangle) + k)]) * to_world;
  }
  return 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).length();
}

bool has_area(const Mesh& mesh, int layer) {
  const std::vector<Vec2>& uv = mesh.uv_layers[std::size_t(layer)].uv;
  double sum = 0;
  for (std::size_t corner = 0; corner + 2 < mesh.triangle_loops.size(); corner += 3) {
    const auto* loops = &mesh.triangle_loops[corner];
    sum += uv_area(uv[loops[0]], uv[loops[1]], uv[loops[2]]);
  }
  return sum > 1e-12;
}

/// Layer that is the lightmap's by its name or its place.
std::optional<int> conventional_layer(const Mesh& mesh) {
  for (const char* name : {"Lightmap", "UV2", "lightmap"}) {
    if (const auto layer = layer_named(mesh, name)) return layer;
  }
  if (mesh.uv_layers.size() > 1) return 1;
  return std::nullopt;
}

/// The first slot with the same material: several may hold it. Empty slots stay apart.
std::uint32_t first_slot(const std::vector<std::string>& slots, std::uint32_t slot) {
  if (slot >= slots.size() || slots[slot].empty()) return slot;
  return static_cast<std::uint32_t>(std::find(slots.begin(), slots.end(), slots[slot]) - slots.begin());
}

}  // namespace

UvChoice choose_lightmap_uv(const Mesh& mesh, const ObjectSettings& settings, const std::string& object) {
  const bool may_unwrap = settings.unwrap != ObjectSettings::Unwrap::never;
  if (settings.unwrap == ObjectSettings::Unwrap::always) return {std::nullopt, "asked for"};
  std::optional<int> layer = settings.uv.empty() ? conventional_layer(mesh) : layer_named(mesh, settings.uv);
  if (!layer && !settings.uv.empty()) {
    fail(ExitCode::invalid_input,
         "object '{}' has no UV layer '{}' (it has {}): name another with --uv, or let it be unwrapped with "
         "--unwrap always",
         object, settings.uv, layer_names(mesh));
  }
  if (!layer && may_unwrap) return {std::nullopt, "no lightmap UV layer"};
  if (!layer) {
    fail(ExitCode::invalid_input,
         "object '{}' has no lightmap UV layer (it has {}): name one with --uv, or allow --unwrap auto",
         object, layer_names(mesh));
  }
  const std::string& name = mesh.uv_layers[std::size_t(*layer)].name;
  if (has_area(mesh, *layer)) return {layer, "layer '" + name + "'"};
  if (may_unwrap && settings.uv.empty()) return {std::nullopt, "layer '" + name + "' has no area"};
  fail(ExitCode::invalid_input,
       "UV layer '{}' of object '{}' has no area (all UVs in one point or line): unwrap it, or pass --unwrap "
       "always",
       name, object);
}

std::optional<int> choose_tangent_uv(const Mesh& mesh, const ObjectSettings& settings,
                                     const std::string& object) {
  if (!settings.tangent_uv.empty()) {
    const auto layer = layer_named(mesh, settings.tangent_uv);
    if (layer) return layer;
    fail(ExitCode::invalid_input,
         "object '{}' has no UV layer '{}' for its tangents (it has {}): name another with --tangent-uv",
         object, settings.tangent_uv, layer_names(mesh));
  }
  const int layer = mesh.render_uv >= 0 ? mesh.render_uv : 0;
  if (mesh.uv_layers.empty() || !has_area(mesh, layer)) return std::nullopt;
  return layer;
}

Areas areas(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, const std::vector<Vec2>& uv,
            const Mat44& to_world) {
  Areas sum;
  for (const std::uint32_t triangle : triangles) {
    sum.world += world_area(mesh, triangle, to_world);
    const auto* loops = &mesh.triangle_loops[3 * std::size_t(triangle)];
    sum.uv += uv_area(uv[loops[0]], uv[loops[1]], uv[loops[2]]);
  }
  return sum;
}

bool has_surface(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, const Mat44& to_world) {
  return std::any_of(triangles.begin(), triangles.end(), [&](std::uint32_t triangle) {
    return !triangle_shape(mesh, triangle, to_world).flat();
  });
}

int wanted_resolution(const ObjectSettings& settings, const Areas& areas) {
  const double most = 1 << 30;
  const auto rounded_up = [most](double side) {
    return static_cast<int>(std::ceil(std::min(side, most) / 4 - 1e-6)) * 4;
  };
  if (settings.texels_per_unit <= 0) return rounded_up(settings.resolution);
  if (!(areas.uv > 0)) return rounded_up(settings.min_resolution);
  return rounded_up(settings.texels_per_unit * std::sqrt(areas.world / areas.uv));
}

int choose_resolution(const ObjectSettings& settings, const Areas& areas) {
  const int wanted = wanted_resolution(settings, areas);
  if (settings.texels_per_unit <= 0) return wanted;
  const int lowest = (settings.min_resolution + 3) / 4 * 4;
  return std::clamp(wanted, lowest, std::max(lowest, settings.max_resolution / 4 * 4));
}

std::vector<Part> split_mesh(const Mesh& mesh, const std::vector<std::string>& slots,
                             ObjectSettings::Split mode) {
  std::vector<std::uint32_t> label(mesh.triangles(), 0);
  if (mode == ObjectSettings::Split::loose) label = loose_parts(mesh);
  if (mode == ObjectSettings::Split::material) {
    for (std::size_t t = 0; t < label.size(); ++t)
      label[t] = first_slot(slots, mesh.polygon_slot[mesh.triangle_polygon[t]]);
  }
  const std::uint32_t last = label.empty() ? 0 : *std::max_element(label.begin(), label.end());
  std::vector<Part> parts(last + 1);
  for (std::uint32_t t = 0; t < label.size(); ++t) parts[label[t]].triangles.push_back(t);
  for (std::size_t i = 0; i < parts.size() && mode != ObjectSettings::Split::none; ++i) {
    const bool named = mode == ObjectSettings::Split::material && i < slots.size() && !slots[i].empty();
    parts[i].name =
        named ? slots[i] : (mode == ObjectSettings::Split::material ? "slot" : "part") + std::to_string(i);
  }
  std::erase_if(parts, [](const Part& part) { return part.triangles.empty(); });
  return parts;
}

}  // namespace rnmbake
