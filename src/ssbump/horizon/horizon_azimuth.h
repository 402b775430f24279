// ssbump/horizon/horizon_azimuth.h - the directions of a horizon sweep, with their weights.
#pragma once

#include "ssbump/horizon/horizon_grid.h"
#include "ssbump/map/weights.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rnmbake {

/// Weight of one direction in the plane in each of the five channels, as share of the whole open sky's.
struct AzimuthLobes {
  static constexpr int table_steps = 256;

  struct Linear {
    float along = 0, up = 0;        // times Elevation's
    float begins = 0, at_most = 0;  // below this sine the lobe is 0: there it counts for so much
  };
  std::array<Linear, SsbumpWeights::channels> linear;
  /// Table by the horizon's sine, for powers other than 1: channels 0 to 3, table_steps + 2 entries each.
  std::vector<float> table;
};

/// Point of the surface between two heights: `part` of the distance from `at` to the next line on the ray's
/// side.
struct RowCrossing {
  std::ptrdiff_t at = 0;  // in memory, from the texel
  float part = 0;
};

/// A ray's way from one row of texels to the next, through one patch, or through two where it crosses a line
/// between. Slopes are heights over the eye times `per_height`, so for one step.
struct NearStep {
  /// The middle of the way across one patch: there the surface may stand higher than where the patch begins
  /// and ends. Its height is the mean of those two plus the patch's twist times `twist`.
  struct Middle {
    bool matters = false;  // false: the twist bends the patch too little
    float twist = 0, per_height = 0;
  };
  RowCrossing row;  // of the next row
  float per_height = 0;
  Middle middle;
  bool crosses = false;     // true: the ray crosses a line, and the members below hold the second patch
  std::ptrdiff_t last = 0;  // in this row, the second line on the way's side: the second patch's corner
  float cross_part = 0, cross_per_height = 0;
  Middle second_middle;
};

/// A direction and its opposite, as lines over a grid: with each step they move aside by slope <= 1.
struct Azimuth {
  int shift = 0;                      // lines over one period of steps, where they repeat
  std::int64_t aside = 0, steps = 1;  // the slope: so many lines aside in so many steps
  double slope = 0;
  std::vector<int> whole, nearest;  // of each step: how far aside, rounded down; to the nearest
  std::vector<float> part;          // what rounding down took away
  float per_step = 0;               // 1 / length of a step
  struct Way {
    int side = 1;     // the lines that the way comes near to are those after, or before (-1)
    float steep = 0;  // |slope|
    std::vector<NearStep> near;
    RowCrossing beyond;  // straight from the texel's centre, one step behind the near rows
    AzimuthLobes lobes;
  };
  std::array<Way, 2> ways;  // forth and back
};

/// Directions evenly around the plane, each with its opposite: the first is `offset` (0 to 1) of the distance
/// of two from the one along a row.
struct AzimuthOptions {
  int azimuths = 64;  // rounded up to an even number
  double offset = 0.5;
  int near_rows = 8;
  double power = 1;
};

/// Rounds down.
[[nodiscard]] inline std::int64_t floor_div(std::int64_t a, std::int64_t b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

/// The azimuths of both grids (steps along rows and along columns): of each direction the grid over which it
/// moves aside by at most a line for each step. Slopes are whole numbers of lines for one period, an even
/// number where it can be: then lines run into themselves behind a border, and a tile moved by half its size
/// has the same ones. Each azimuth counts for the angles that are nearer to it than to the next.
struct AzimuthSets {
  std::vector<Azimuth> by_rows, by_columns;
};
[[nodiscard]] AzimuthSets make_azimuths(const HorizonGrid& by_rows, const HorizonGrid& by_columns,
                                        const AzimuthOptions& options);

}  // namespace rnmbake
