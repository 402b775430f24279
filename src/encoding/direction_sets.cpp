#include "encoding/direction_sets.h"

#include <cmath>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

/// Three directions tilted by `tilt` degrees, the first of them at `azimuth`.
void add_ring(BasisSet& set, double tilt, double azimuth) {
  for (int i = 0; i < 3; ++i) {
    const Vec3d direction = direction_at(tilt * pi / 180, (azimuth + 120 * i) * pi / 180);
    set.directions.push_back({fmt::format("d{}", set.directions.size() - 4), Vec3(direction)});
  }
}

}  // namespace

std::optional<BasisSet> direction_set(std::string_view name) {
  const bool is_h6 = name == "h6" || name == "sg", is_sh3 = name == "sh3";
  if (!is_h6 && !is_sh3 && name != "l1") return std::nullopt;
  BasisSet set = flat_and_rnm();
  set.name = name;
  add_ring(set, std::acos(std::sqrt(1.0 / 3)) * 180 / pi, 60);
  if (is_h6 || is_sh3) add_ring(set, 30, 0);
  if (is_sh3) add_ring(set, 80, 60);
  return set;
}

}  // namespace rnmbake
