// bake/targets.h - targets: objects or parts of them, with their UVs and their size.
#pragma once

#include "base/math.h"
#include "config/bake_settings.h"
#include "encoding/flip_green.h"
#include "scene/survey.h"
#include "scene/uv_report.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

/// Layer of the lightmap; empty where the object has to be unwrapped, for `reason`.
struct UvChoice {
  std::optional<int> layer;
  std::string reason;
};

/// The layer named by the settings, else Lightmap / UV2 / lightmap, else the second layer, else unwrapping.
/// A layer whose UVs have no area counts as absent. Throws Error(invalid_input) naming the object.
[[nodiscard]] UvChoice choose_lightmap_uv(const Mesh& mesh, const ObjectSettings& settings,
                                          const std::string& object);

/// The normal map's layer: the one named, else active-render, else the first; empty: the object has none, or
/// its UVs have no area.
[[nodiscard]] std::optional<int> choose_tangent_uv(const Mesh& mesh, const ObjectSettings& settings,
                                                   const std::string& object);

struct Areas {
  double world = 0;  // square units
  double uv = 0;     // share of the unit square, overlaps counted twice
};
[[nodiscard]] Areas areas(const Mesh& mesh, const std::vector<std::uint32_t>& triangles,
                          const std::vector<Vec2>& uv, const Mat44& to_world);

/// Whether any of the triangles is more than a line or a point.
[[nodiscard]] bool has_surface(const Mesh& mesh, const std::vector<std::uint32_t>& triangles,
                               const Mat44& to_world);

/// Side that texels_per_unit asks for, whatever the limits; the resolution without it.
[[nodiscard]] int wanted_resolution(const ObjectSettings& settings, const Areas& areas);

/// Side of the square lightmap: a multiple of 4 within the limits.
[[nodiscard]] int choose_resolution(const ObjectSettings& settings, const Areas& areas);

/// A piece of a mesh that gets a lightmap of its own.
struct Part {
  std::string name;  // "" for a whole object, else the material's name or "part<n>"
  std::vector<std::uint32_t> triangles;
};
[[nodiscard]] std::vector<Part> split_mesh(const Mesh& mesh, const std::vector<std::string>& slots,
                                           ObjectSettings::Split mode);

using Uvs = std::shared_ptr<const std::vector<Vec2>>;  // one for each loop

struct Target {
  std::size_t object = 0;  // index into SceneSurvey::objects
  std::string key;         // the object's key, with "/part" where it was split
  Part part;
  Uvs uv, tangent_uv;
  std::string uv_layer;       // name; "Lightmap" where it was unwrapped
  std::string tangent_layer;  // name; the lightmap layer's where the object has no other
  bool unwrapped = false;
  bool flip_green = false;  // basis y points along falling v, for normal maps with Y down
  int width = 0, height = 0;
  int wanted_side = 0;  // texels_per_unit's, before max_resolution
  UvReport uv_report;   // at that size
};

/// A basis vector in the right-handed, Y-up frame of scene/tangents.h, whatever the target's green channel.
[[nodiscard]] inline Vec3 in_frame(const Vec3& basis, const Target& target) {
  return target.flip_green ? flip_green(basis) : basis;
}

/// An object of the scene that is not baked, and why.
struct Skipped {
  std::string key, reason;
};

struct TargetList {
  std::vector<Target> targets;
  std::vector<ObjectSettings> settings;  // [targets]
  std::vector<Skipped> skipped;
};

}  // namespace rnmbake
