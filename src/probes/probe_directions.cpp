#include "probes/probe_directions.h"

#include "encoding/ambient_cube.h"
#include "encoding/sh.h"

#include <algorithm>

namespace rnmbake {

const PerProbeDirection<Vec3>& probe_directions() {
  static const PerProbeDirection<Vec3> directions = [] {
    PerProbeDirection<Vec3> made;
    const std::array<Vec3, 6> axes = ambient_cube_axes();
    std::ranges::copy(axes, made.begin());
    for (std::size_t i = 0; i < 8; ++i) {
      const auto side = [&](std::size_t bit) { return (i & bit) != 0 ? 1.0F : -1.0F; };
      made[axes.size() + i] = unit(Vec3(side(1), side(2), side(4)));
    }
    return made;
  }();
  return directions;
}

const PerProbeDirection<const char*>& probe_direction_names() {
  static constexpr PerProbeDirection<const char*> names{"px", "nx", "py", "ny", "pz", "nz", "c0",
                                                        "c1", "c2", "c3", "c4", "c5", "c6", "c7"};
  return names;
}

const PerProbeDirection<float>& probe_direction_weights() {
  static constexpr float axis = 1.0F / 15, corner = 3.0F / 40;
  static constexpr PerProbeDirection<float> weights{axis,   axis,   axis,   axis,   axis,   axis,   corner,
                                                    corner, corner, corner, corner, corner, corner, corner};
  return weights;
}

std::array<Vec3, 9> harmonics_of(const PerProbeDirection<Vec3>& irradiance) {
  constexpr auto sphere = static_cast<float>(4 * pi);
  std::array<Vec3, 9> harmonics;
  harmonics.fill(Vec3(0));
  for (std::size_t i = 0; i < probe_direction_count; ++i) {
    const auto basis = sh_basis(probe_directions()[i]);
    const Vec3 light = irradiance[i] * (sphere * probe_direction_weights()[i]);
    for (std::size_t k = 0; k < 9; ++k) harmonics[k] += light * basis[k];
  }
  for (std::size_t k = 0; k < 9; ++k) harmonics[k] /= sh_cosine_over_pi[k == 0 ? 0 : k < 4 ? 1 : 2];
  return harmonics;
}

Vec3 irradiance_of(std::span<const Vec3> harmonics, const Vec3& normal, int order) {
  const auto basis = sh_irradiance_basis(normal);
  const auto count = std::min(harmonics.size(), static_cast<std::size_t>(order) * std::size_t(order));
  Vec3 light(0);
  for (std::size_t k = 0; k < count; ++k) light += harmonics[k] * basis[k];
  return light;
}

}  // namespace rnmbake
