#include "trace/recipe.h"

#include "base/error.h"
#include "trace/shadow_terminator.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rnmbake {
namespace {

/// Bends `n` towards the face normal until the mirror image of `wo` is at least a little above the face, as
/// Cycles did with every closure before 3.6. The bent normal lies in the plane of `n` and the face normal;
/// with the height of the mirrored direction fixed, its squared height solves a quadratic equation.
Vec3 tilt_clamped(const Vec3& n, const Vec3& face, const Vec3& wo) {
  const float up = wo.dot(face), least = std::min(0.9F * up, 0.01F);
  const auto mirrored_height = [&](float along, float height, float side) {
    return 2 * (along * side + height * up) * height - up;
  };
  if (2 * n.dot(wo) * n.dot(face) - up >= least) return n;

  const Vec3 across = n - face * n.dot(face);
  if (!(across.length2() > 0)) return face;
  const Vec3 x = across.normalized();
  const float side = wo.dot(x), a = side * side + up * up;
  const float root = std::sqrt(std::max(0.0F, side * side * (a - least * least))), middle = up * least + a;
  Vec3 best = face;
  float lowest = 2;
  for (const float square : {0.5F * (middle + root) / a, 0.5F * (middle - root) / a}) {
    if (!(square > 1e-5F && square <= 1 + 1e-5F)) continue;
    const float height = std::sqrt(square), along = std::sqrt(std::max(0.0F, 1 - square));
    const float mirrored = mirrored_height(along, height, side);
    if (mirrored < 1e-5F || mirrored >= lowest) continue;
    lowest = mirrored;
    best = x * along + face * height;
  }
  return best;
}

bool is_at_least(const std::string& version, int major, int minor) {
  int have_major = 0, have_minor = 0;
  if (std::sscanf(version.c_str(), "%d.%d", &have_major, &have_minor) != 2) {
    fail(ExitCode::usage, "'{}' is no version of Blender; write it like 4.3", version);
  }
  return have_major > major || (have_major == major && have_minor >= minor);
}

}  // namespace

Recipe::Recipe(const RecipeFaults& faults, const std::string& blender_version)
    : faults_(faults), microfacets_(is_at_least(blender_version, 4, 5)) {}

Closure Recipe::closure(const Vec3& basis, const Vec3& smooth, const Vec3& face, const Vec3& wo) const {
  return {faults_.tilt_clamp ? tilt_clamped(basis, face, wo) : basis, smooth, true};
}

float Recipe::shadowing(const Closure& closure, const Vec3& direction) const {
  const float up = closure.smooth.dot(direction), between = closure.smooth.dot(closure.normal);
  if (!(up > 0) || !(between > 0)) return 0;
  if (between > 1 - 1e-6F) return 1;  // not bent
  if (microfacets_) {  // "A Microfacet-Based Shadowing Function to Solve the Bump Terminator Problem"
    const float tangent2 = 1 / (between * between) - 1, alpha2 = std::min(1.0F, 0.125F * tangent2);
    return 2 / (1 + std::sqrt(1 + alpha2 * (1 / (up * up) - 1)));
  }
  const float g = up / (closure.normal.dot(direction) * between);  // Chiang et al. 2019
  return g >= 1 ? 1 : g * (1 + g - g * g);
}

Vec3 without_color(const Vec3& light, const Vec3& albedo) {
  float sum = 0;
  int colors = 0;
  for (int c = 0; c < 3; ++c) {
    if (!(albedo[c] > 0)) continue;
    sum += light[c];
    ++colors;
  }
  if (colors == 0) return Vec3(0);
  Vec3 result(sum / static_cast<float>(colors));
  for (int c = 0; c < 3; ++c) {
    if (albedo[c] > 0) result[c] = light[c];
  }
  return result;
}

OwnSurface::OwnSurface(const TraceScene& scene, const GatherTarget& target)
    : scene_(scene), surface_(*target.surface), object_(static_cast<std::uint32_t>(target.object)) {
  const DiffuseScene& diffuse_scene = scene.diffuse_scene();
  const SceneObject& it = diffuse_scene.survey.objects[target.object];
  const Mesh& mesh = diffuse_scene.survey.mesh_of(it);
  const auto& materials = diffuse_scene.object_materials[target.object];
  const bool mirrored = it.to_world.determinant() < 0;
  for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
    const std::uint32_t source = surface_.triangles[t].source;
    if (source >= of_source_.size()) of_source_.resize(std::size_t(source) + 1, absent);
    of_source_[source] = static_cast<std::uint32_t>(t);
    const std::size_t slot = mesh.polygon_slot[mesh.triangle_polygon[source]];
    materials_.push_back(static_cast<std::uint32_t>(materials[std::min(slot, materials.size() - 1)]));
    const int uvs = diffuse_scene.materials[materials_.back()].picture_uv;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t corner = 3 * std::size_t(source) + (mirrored && k > 0 ? 3 - k : k);
      uv_.push_back(uvs < 0 ? Vec2(0) : diffuse_scene.picture_uvs[uvs][mesh.triangle_loops[corner]]);
    }
  }
}

Vec3 OwnSurface::albedo(std::uint32_t triangle, const Vec3& weights) const {
  const Vec2* uv = &uv_[3 * std::size_t(triangle)];
  return scene_.materials().albedo(materials_[triangle],
                                   uv[0] * weights.x + uv[1] * weights.y + uv[2] * weights.z);
}

std::uint32_t OwnSurface::triangle_of(const Vertex& vertex) const {
  if (scene_.triangles().object[vertex.triangle] != object_) return absent;
  const std::uint32_t source = scene_.triangles().source[vertex.triangle];
  return source < of_source_.size() ? of_source_[source] : absent;
}

Vec3 OwnSurface::start_below(std::uint32_t triangle, const Vec3& weights, const Vec3& start,
                             const Vec3& direction, float side) const {
  const SurfaceTriangle& flat = surface_.triangles[triangle];
  SmoothTriangle smooth;
  Vec3 normal(0);
  bool curved = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const SurfaceCorner& corner = flat.corners[k];
    smooth.positions[k] = corner.position;
    smooth.normals[k] = corner.frame.normal * side;
    normal += smooth.normals[k] * weights[static_cast<int>(k)];
    curved |= corner.frame.normal.dot(flat.normal) < 1 - 1e-6F;
  }
  if (curved && normal.dot(direction) > 0) return start + terminator_offset(smooth, weights);
  // In Cycles shadow rays do not hit the triangle that they start from.
  return start - flat.normal * (side * 2 * (ray_offset_at(start) + flat.height));
}

Vec3 OwnSurface::start_below(const Vertex& vertex, const Vec3& direction) const {
  const Vec3 weights(1 - vertex.b1 - vertex.b2, vertex.b1, vertex.b2);
  return start_below(triangle_of(vertex), weights, vertex.start(), direction, vertex.back ? -1.0F : 1.0F);
}

Vec3 OwnSurface::direction(const Vertex& vertex, const Vec3& basis) const {
  const auto& corners = surface_.triangles[triangle_of(vertex)].corners;
  const float weights[3] = {1 - vertex.b1 - vertex.b2, vertex.b1, vertex.b2};
  Vec3 sum(0);
  for (std::size_t k = 0; k < 3; ++k) {
    sum += corners[k].frame.to_world(basis) * weights[k];
  }
  return sum.normalized() * (vertex.back ? -1.0F : 1.0F);
}

}  // namespace rnmbake
