// Volumes of light probes whose light is known at every place and normal; formats_check.py knows it, too.
#pragma once

#include "base/math.h"
#include "probes/probe_volume.h"

#include <array>
#include <cmath>
#include <vector>

namespace rnmbake {

/// E/pi within six walls, of bands 0 to 2: red at +x, cyan at -x, green at +y, magenta at -y, blue at +z,
/// yellow at -z, and a tenth of xy, yz and xz in red, green and blue that no axis sees.
inline Vec3 light_of_walls(const Vec3& n) {
  const std::array<Vec3, 3> ahead{Vec3(1, 0.4F, 0.4F), Vec3(0.5F, 1.1F, 0.5F), Vec3(0.4F, 0.4F, 1.2F)};
  const std::array<Vec3, 3> behind{Vec3(0.4F, 1, 1), Vec3(1.1F, 0.5F, 1.1F), Vec3(1.2F, 1.2F, 0.4F)};
  Vec3 light(n.x * n.y / 10, n.y * n.z / 10, n.x * n.z / 10);
  for (std::size_t k = 0; k < 3; ++k) {
    const float along = n[static_cast<int>(k)];
    light += (ahead[k] + behind[k]) * (along * along / 2) + (ahead[k] - behind[k]) * (along / 2);
  }
  return light;
}

template <typename LightAt>
LightProbe sample_probe(const Vec3d& place, const LightAt& light_at) {
  LightProbe probe;
  probe.position = place;
  for (std::size_t i = 0; i < probe_direction_count; ++i)
    probe.irradiance[i] = light_at(probe_directions()[i]);
  probe.harmonics = harmonics_of(probe.irradiance);
  return probe;
}

/// Its probe x, y, z: the walls' light times (1 + x) (1 + y / 2) (1 + z / 4) with `told_apart`.
inline ProbeVolume sample_box(const std::string& name, const ProbeGrid& grid, bool told_apart) {
  ProbeVolume volume;
  volume.name = name;
  volume.grid = grid;
  for (int z = 0; z < grid.counts[2]; ++z) {
    for (int y = 0; y < grid.counts[1]; ++y) {
      for (int x = 0; x < grid.counts[0]; ++x) {
        const double scale = told_apart ? (1.0 + x) * (1 + y / 2.0) * (1 + z / 4.0) : 1;
        volume.probes.push_back(sample_probe(
            grid.place(x, y, z), [&](const Vec3& n) { return light_of_walls(n) * float(scale); }));
      }
    }
  }
  return volume;
}

/// "room": one cell within the walls. "hall": 2 x 3 x 4 probes, unequal steps, told apart; its probe (1, 2,
/// 3) is buried. "turned": 3 x 2 x 2, told apart, 30 degrees from x towards y.
/// "single": one probe.
inline std::vector<ProbeVolume> sample_boxes() {
  ProbeGrid room;
  room.counts = {2, 2, 2};
  room.first = {-1, -1, -1};
  room.steps = {Vec3d(2, 0, 0), Vec3d(0, 2, 0), Vec3d(0, 0, 2)};
  ProbeGrid hall;
  hall.counts = {2, 3, 4};
  hall.first = {10, -20, 3};
  hall.steps = {Vec3d(0.5, 0, 0), Vec3d(0, 1.5, 0), Vec3d(0, 0, 0.75)};
  ProbeGrid turned;
  turned.counts = {3, 2, 2};
  turned.first = {5, 6, 7};
  const double c = std::sqrt(0.75), s = 0.5;
  turned.steps = {Vec3d(2 * c, 2 * s, 0), Vec3d(-s, c, 0), Vec3d(0, 0, 1.5)};
  ProbeGrid single;
  single.first = {3, -4, 5};
  single.steps = {Vec3d(2, 0, 0), Vec3d(0, 3, 0), Vec3d(0, 0, 4)};
  std::vector<ProbeVolume> volumes{sample_box("room", room, false), sample_box("hall", hall, true),
                                   sample_box("turned", turned, true), sample_box("single", single, false)};
  volumes[1].probes[hall.index(1, 2, 3)].validity = 0.125F;
  return volumes;
}

/// Two points: the walls' light, and half of it.
inline ProbeVolume sample_points() {
  ProbeVolume volume;
  volume.name = "two points";
  volume.probes.push_back(sample_probe({1, 2, 3}, light_of_walls));
  volume.probes.push_back(sample_probe({-4, 5, -6}, [](const Vec3& n) { return light_of_walls(n) * 0.5F; }));
  return volume;
}

}  // namespace rnmbake
