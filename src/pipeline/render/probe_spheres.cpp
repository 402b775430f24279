#include "pipeline/render/probe_spheres.h"

#include "base/error.h"
#include "probes/cell_lookup.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace rnmbake {
namespace {

/// Radius 1, smooth; of quads, those at the poles squeezed to triangles.
Mesh unit_sphere() {
  constexpr std::uint32_t around = 16, down = 8;
  Mesh mesh;
  mesh.name = "light probe";
  for (std::uint32_t row = 0; row <= down; ++row) {
    for (std::uint32_t column = 0; column < around; ++column)
      mesh.positions.emplace_back(direction_at(pi * row / down, 2 * pi * column / around));
  }
  const auto add_triangle = [&](std::array<std::uint32_t, 3> corners) {
    const auto first = static_cast<std::uint32_t>(mesh.loop_vertex.size());
    mesh.triangle_polygon.push_back(static_cast<std::uint32_t>(mesh.polygon_start.size()));
    mesh.polygon_start.push_back(first);
    mesh.polygon_size.push_back(3);
    mesh.polygon_slot.push_back(0);
    for (std::uint32_t k = 0; k < 3; ++k) {
      mesh.triangle_loops.push_back(first + k);
      mesh.loop_vertex.push_back(corners[k]);
      mesh.loop_normal.push_back(mesh.positions[corners[k]]);
    }
  };
  for (std::uint32_t row = 0; row < down; ++row) {
    for (std::uint32_t column = 0; column < around; ++column) {
      const auto at = [&](std::uint32_t r, std::uint32_t c) { return r * around + c % around; };
      if (row > 0) add_triangle({at(row, column), at(row + 1, column), at(row, column + 1)});
      if (row + 1 < down) add_triangle({at(row, column + 1), at(row + 1, column), at(row + 1, column + 1)});
    }
  }
  return mesh;
}

/// [probes]; units.
std::vector<double> radii_of(const ProbeVolume& volume) {
  constexpr double share = 0.12, alone = 0.1;  // of the shortest step there; units
  std::vector<double> radii(volume.probes.size(), alone);
  if (!volume.grid) return radii;
  const CellLookup cells(volume);
  for (std::size_t i = 0; i < radii.size(); ++i) radii[i] = share * cells.least_step(i);
  return radii;
}

}  // namespace

void add_probe_spheres(const std::vector<ProbeVolume>& volumes, DiffuseScene& scene) {
  std::size_t count = 0;
  for (const ProbeVolume& volume : volumes) count += volume.probes.size();
  if (count > most_spheres)
    fail(ExitCode::unsupported, "{} probes are too many to show as spheres; {} are the most", count,
         most_spheres);
  const std::array<std::pair<const char*, Vec3>, 3> states{{{"probe in the open", Vec3(0.8F)},
                                                            {"moved", Vec3(0.2F, 0.8F, 0.2F)},
                                                            {"filled", Vec3(0.8F, 0.1F, 0.1F)}}};
  const auto first_material = static_cast<int>(scene.materials.size());
  for (const auto& [name, albedo] : states) {
    SurfaceMaterial material;
    material.name = name;
    material.albedo = albedo;
    scene.materials.push_back(material);
  }
  const auto mesh = static_cast<int>(scene.survey.meshes.size());
  scene.survey.meshes.push_back(unit_sphere());
  for (const ProbeVolume& volume : volumes) {
    const std::vector<double> radii = radii_of(volume);
    for (std::size_t i = 0; i < radii.size(); ++i) {
      const LightProbe& probe = volume.probes[i];
      SceneObject object;
      object.key = object.name = "light probe " + std::to_string(scene.survey.objects.size());
      object.type = "MESH";
      object.mesh = mesh;
      object.to_world.setScale(Vec3d(radii[i]));
      for (int axis = 0; axis < 3; ++axis) object.to_world[3][axis] = probe.position[axis];
      object.slots = {""};
      scene.survey.objects.push_back(std::move(object));
      scene.object_materials.push_back({first_material + static_cast<int>(probe.state)});
      if (!scene.unlit.empty()) scene.unlit.push_back(0);
    }
  }
}

}  // namespace rnmbake
