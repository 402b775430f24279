// ssbump/horizon/horizon_sums.h - integrals of the lobes over the texels' horizons, summed over the azimuths.
#pragma once

#include "base/large_vector.h"
#include "ssbump/horizon/horizon_azimuth.h"
#include "ssbump/horizon/horizon_grid.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rnmbake {

/// Sums of the texels of a range of steps and lines: one plane for each channel, lines side by side as in the
/// grid.
struct SweepTarget {
  int first_step = 0, last_step = 0;  // the last is the first that is not wanted
  int first_line = 0, last_line = 0;
  int planes = 4;  // 4: power 1, straight up and ambient are the same
  LargeVector<float> sums;

  [[nodiscard]] std::size_t pitch() const {
    return row_pitch(static_cast<std::size_t>(last_line - first_line));
  }
  [[nodiscard]] int steps() const { return last_step - first_step; }
  [[nodiscard]] std::size_t plane() const { return pitch() * static_cast<std::size_t>(steps()); }
  void make_room() { sums.resize(plane() * static_cast<std::size_t>(planes)); }
};

/// The sine of a horizon's elevation as a 16-bit number: this one stands for 1.
inline constexpr float whole_sine = 65535;

/// Sines of horizons of some azimuths, until they are added up: of each, a plane of the target forth and one
/// back. Few of them at once keep them near the processor, more of them save ways to the sums.
struct HorizonSines {
  static constexpr int azimuths = 4;
  LargeVector<std::uint16_t> values;

  void make_room(const SweepTarget& target) { values.resize(2 * azimuths * target.plane()); }
  [[nodiscard]] std::uint16_t* of(const SweepTarget& target, int azimuth, int way) {
    return values.data() + static_cast<std::size_t>(2 * azimuth + way) * target.plane();
  }
};

/// Adds the lobes' integrals over the horizons of these azimuths to the sums of one step; overwrites them
/// where the azimuths are the first. `step`: of the target.
void add_seen(SweepTarget& target, const HorizonSines& sines, std::span<const Azimuth> azimuths, int step,
              bool are_first);

}  // namespace rnmbake
