// tests/trace/trace_scenes.h - scenes of a few quads, built in memory, and their gathering.
#pragma once

#include "encoding/basis_set.h"
#include "scene/diffuse_scene.h"
#include "scene/surface.h"
#include "trace/gather.h"
#include "trace/geometry/triangles.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace rnmbake {

/// A quad with the UVs (0,0) (1,0) (1,1) (0,1); anti-clockwise from the front.
using Quad = std::array<Vec3, 4>;

/// An object of these quads, in world space; the quads share the unit square evenly, side by side.
inline void add_object(DiffuseScene& scene, const std::string& name, const std::vector<Quad>& quads,
                       const Vec3& albedo, const Vec3& emission = Vec3(0)) {
  Mesh mesh;
  mesh.name = name;
  UvLayer layer{"Lightmap", {}};
  for (std::size_t q = 0; q < quads.size(); ++q) {
    const auto base = static_cast<std::uint32_t>(4 * q);
    const Vec3 normal = (quads[q][1] - quads[q][0]).cross(quads[q][3] - quads[q][0]).normalized();
    const float left = float(q) / float(quads.size()), right = float(q + 1) / float(quads.size());
    for (std::uint32_t k = 0; k < 4; ++k) {
      mesh.positions.push_back(quads[q][k]);
      mesh.loop_vertex.push_back(base + k);
      mesh.loop_normal.push_back(normal);
      layer.uv.emplace_back(k == 1 || k == 2 ? right : left, k >= 2 ? 1.0F : 0.0F);
    }
    for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.triangle_loops.push_back(base + k);
    for (int t = 0; t < 2; ++t) mesh.triangle_polygon.push_back(static_cast<std::uint32_t>(q));
    mesh.polygon_start.push_back(base);
    mesh.polygon_size.push_back(4);
    mesh.polygon_slot.push_back(0);
  }
  mesh.uv_layers.push_back(layer);
  mesh.active_uv = mesh.render_uv = 0;
  SceneObject object;
  object.key = object.name = name;
  object.type = "MESH";
  object.mesh = static_cast<int>(scene.survey.meshes.size());
  object.slots = {name};
  scene.survey.meshes.push_back(std::move(mesh));
  scene.survey.objects.push_back(object);
  SurfaceMaterial material;
  material.name = name;
  material.albedo = albedo;
  material.emission = emission;
  scene.object_materials.push_back({static_cast<int>(scene.materials.size())});
  scene.materials.push_back(material);
}

/// A square in the plane z = height that faces up, or down.
inline Quad level(float half, float height, bool up = true, const Vec3& middle = Vec3(0)) {
  const auto at = [&](float x, float y) { return middle + Vec3(x, y, height); };
  if (up) return {at(-half, -half), at(half, -half), at(half, half), at(-half, half)};
  return {at(-half, half), at(half, half), at(half, -half), at(-half, -half)};
}

/// Six walls that face inwards, of a cube around `middle`.
inline std::vector<Quad> room(float half, const Vec3& middle = Vec3(0)) {
  const auto at = [&](float x, float y, float z) { return middle + Vec3(x, y, z) * half; };
  return {{at(-1, -1, -1), at(1, -1, -1), at(1, 1, -1), at(-1, 1, -1)},
          {at(-1, 1, 1), at(1, 1, 1), at(1, -1, 1), at(-1, -1, 1)},
          {at(-1, -1, -1), at(-1, -1, 1), at(1, -1, 1), at(1, -1, -1)},
          {at(1, 1, -1), at(1, 1, 1), at(-1, 1, 1), at(-1, 1, -1)},
          {at(-1, 1, -1), at(-1, 1, 1), at(-1, -1, 1), at(-1, -1, -1)},
          {at(1, -1, -1), at(1, -1, 1), at(1, 1, 1), at(1, 1, -1)}};
}

/// Six walls of a box that face inwards, or outwards.
inline std::vector<Quad> box(const Vec3& low, const Vec3& high, bool inwards = true) {
  const Vec3 middle = (low + high) / 2, half = (high - low) / 2;
  std::vector<Quad> quads = room(1);
  for (Quad& quad : quads) {
    for (Vec3& corner : quad) corner = middle + corner * half;
    if (!inwards) std::swap(quad[1], quad[3]);
  }
  return quads;
}

inline LightInfo light(const std::string& type, double energy, std::map<std::string, double> sizes) {
  LightInfo info;
  info.name = info.type = type;
  info.energy = energy;
  info.sizes = std::move(sizes);
  return info;
}

/// In the space of a TraceScene.
inline Surface surface_of(const DiffuseScene& scene, std::size_t object) {
  const SceneObject& it = scene.survey.objects[object];
  const Mesh& mesh = scene.survey.mesh_of(it);
  std::vector<std::uint32_t> all(mesh.triangles());
  for (std::size_t t = 0; t < all.size(); ++t) all[t] = static_cast<std::uint32_t>(t);
  const std::vector<Vec2>& uv = mesh.uv_layers.front().uv;
  return make_surface(mesh, all, uv, tangent_frames(mesh, uv, it.to_world),
                      it.to_world * Mat44().setTranslation(-middle_of(scene)));
}

/// What a direction of the basis gathers of a uniform sky of radiance 1, on a flat floor.
inline const double sky_share = (1 + 1 / std::sqrt(3.0)) / 2;

inline GatherOptions all_directions(int samples, std::uint64_t seed = 0) {
  GatherOptions options;
  options.directions = flat_and_rnm().directions;
  options.samples = samples;
  options.seed = seed;
  options.footprint = Footprint::full;
  return options;
}

/// Gathers for one object of the scene, in the units of Blender 4.3.
inline Gathered gather_one(const DiffuseScene& scene, std::size_t object, const GatherOptions& options,
                           int width = 8, int height = 8) {
  const TraceScene traced(scene, "4.3.2");
  const Surface surface = surface_of(scene, object);
  const std::vector<GatherTarget> targets{{&surface, object, width, height}};
  Gathered result;
  gather(traced, targets, options, [&](std::size_t, Gathered&& gathered) { result = std::move(gathered); });
  return result;
}

}  // namespace rnmbake
