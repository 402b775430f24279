#include "ssbump/horizon_azimuth.h"

#include "ssbump/lobes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace rnmbake {
namespace {

/// The plane's directions in tangent space of one azimuth's two ways, and the angle that it stands for.
struct Spoke {
  Azimuth* azimuth;
  std::array<Vec2, 2> directions;
  double angle;
};

int rounded_shift(double slope, int period) {
  if (period % 2 != 0) return static_cast<int>(std::lround(slope * period));
  return 2 * static_cast<int>(std::lround(slope * period / 2));
}

void lay_lines(Azimuth& azimuth, const GridAxis& steps) {
  constexpr int fine = 4096;  // where lines need not meet themselves
  azimuth.steps = steps.repeats() ? steps.period : fine;
  azimuth.aside = rounded_shift(azimuth.slope, static_cast<int>(azimuth.steps));
  azimuth.shift = steps.repeats() ? static_cast<int>(azimuth.aside) : 0;
  azimuth.slope = static_cast<double>(azimuth.aside) / static_cast<double>(azimuth.steps);
  azimuth.per_step = static_cast<float>(1 / std::sqrt(1 + azimuth.slope * azimuth.slope));
  for (std::int64_t step = 0; step < steps.period; ++step) {
    const std::int64_t whole = floor_div(step * azimuth.aside, azimuth.steps);
    azimuth.whole.push_back(static_cast<int>(whole));
    azimuth.part.push_back(static_cast<float>(step * azimuth.aside - whole * azimuth.steps) /
                           static_cast<float>(azimuth.steps));
    azimuth.nearest.push_back(
        static_cast<int>(floor_div(2 * step * azimuth.aside + azimuth.steps, 2 * azimuth.steps)));
  }
}

constexpr double least_bend = 0.01;  // of a patch's twist, by which its middle may be steeper

/// Where a ray crosses the line between texels that is `row` steps away.
NearTap row_crossing(double slope, int sign, int row, std::ptrdiff_t pitch) {
  const double aside = row * sign * slope, line = std::floor(aside);
  const std::ptrdiff_t at = sign * row * pitch + static_cast<std::ptrdiff_t>(line);
  return {at, at + 1, static_cast<float>(aside - line), static_cast<float>(1.0 / row)};
}

/// How far along a ray it crosses lines between texels up to `rows` steps away, in steps.
std::vector<double> crossings(double slope, int rows) {
  const double steep = std::abs(slope);
  std::vector<double> ways;
  for (int row = 1; row <= rows; ++row) ways.push_back(row);
  for (int line = 1; line < rows * steep; ++line) {
    const double way = line / steep;
    if (way - std::floor(way) >= 1e-6) ways.push_back(way);  // else a texel's centre, which is there already
  }
  std::ranges::sort(ways);
  return ways;
}

/// Where a ray leaves the texel, and where it crosses the lines between texels.
std::vector<NearTap> near_taps(double slope, int sign, int rows, std::ptrdiff_t pitch) {
  const double steep = std::abs(slope);
  const int side = sign * slope < 0 ? -1 : 1;
  std::vector<NearTap> taps;
  taps.push_back(
      {sign * pitch, side, static_cast<float>(steep / (1 + steep)), static_cast<float>(1 + steep)});
  for (const double way : crossings(slope, rows)) {
    const int row = static_cast<int>(std::floor(way));
    if (way == row) {
      taps.push_back(row_crossing(slope, sign, row, pitch));
      continue;
    }
    const int line = side * static_cast<int>(std::lround(way * steep));
    taps.push_back({sign * row * pitch + line, sign * (row + 1) * pitch + line, static_cast<float>(way - row),
                    static_cast<float>(1 / way)});
  }
  return taps;
}

/// The surface is straight along the lines between texels, a parabola along rays across a patch. In the first
/// patch the steepest way is at one of its ends.
std::vector<PatchTap> patch_taps(double slope, int sign, int rows, std::ptrdiff_t pitch) {
  const std::vector<double> ways = crossings(slope, rows);
  std::vector<PatchTap> taps;
  for (std::size_t i = 0; i + 1 < ways.size(); ++i) {
    const double length = ways[i + 1] - ways[i], way = (ways[i] + ways[i + 1]) / 2;
    if (std::abs(slope) * length * length / 4 < least_bend * way) continue;
    const double step = sign * way, line = step * slope, from_step = std::floor(step),
                 from_line = std::floor(line);
    const auto u = static_cast<float>(line - from_line), v = static_cast<float>(step - from_step);
    PatchTap tap;
    tap.at = static_cast<std::ptrdiff_t>(from_step) * pitch + static_cast<std::ptrdiff_t>(from_line);
    tap.shares = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
    tap.per_height = static_cast<float>(1 / way);
    taps.push_back(tap);
  }
  return taps;
}

std::vector<Azimuth> lay_azimuths(const HorizonGrid& grid, const AzimuthOptions& options) {
  const int count = (options.azimuths + 7) / 8 * 2;
  std::vector<Azimuth> set(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    Azimuth& azimuth = set[static_cast<std::size_t>(i)];
    azimuth.slope = std::tan(pi / 2 * ((i + 0.5) / count - 0.5));
    lay_lines(azimuth, grid.steps);
    for (const int sign : {1, -1}) {
      Azimuth::Way& way = azimuth.ways[sign > 0 ? 0 : 1];
      way.taps = near_taps(azimuth.slope, sign, options.near_rows, grid.pitch);
      way.patches = patch_taps(azimuth.slope, sign, options.near_rows, grid.pitch);
      way.beyond = row_crossing(azimuth.slope, sign, options.near_rows + 1, grid.pitch);
    }
  }
  return set;
}

void add_spokes(std::vector<Spoke>& spokes, std::vector<Azimuth>& set, bool transposed) {
  for (std::size_t i = 0; i < set.size(); ++i) {
    const double slope = set[i].slope, angle = std::atan(slope);
    const double before = i > 0 ? (std::atan(set[i - 1].slope) + angle) / 2 : -pi / 4;
    const double after = i + 1 < set.size() ? (std::atan(set[i + 1].slope) + angle) / 2 : pi / 4;
    const double length = std::sqrt(1 + slope * slope);
    const Vec2 forth = transposed ? Vec2(float(1 / length), float(-slope / length))
                                  : Vec2(float(slope / length), float(-1 / length));
    spokes.push_back({&set[i], {forth, -forth}, after - before});
  }
}

/// `whole`: what the open sky counts for, by these azimuths.
void weigh(AzimuthLobes& lobes, const Vec2& direction, double angle, double power,
           const std::array<double, SsbumpWeights::channels>& whole) {
  const auto all = ssbump_lobes(power);
  for (std::size_t c = 0; c < all.size(); ++c) {
    const double along = all[c].axis.x * direction.x + all[c].axis.y * direction.y, z = all[c].axis.z;
    const double scale = angle / whole[c];
    AzimuthLobes::Linear& linear = lobes.linear[c];
    linear.along = static_cast<float>(along * scale / 2);
    linear.up = static_cast<float>(z * scale / 2);
    linear.begins = along < 0 ? static_cast<float>(-along / z) : -1.0F;
    linear.at_most = static_cast<float>(lobe_above(along, z, 1, 0) * scale);
    if (power == 1 || c == SsbumpWeights::ambient) continue;
    for (int i = 0; i <= AzimuthLobes::table_steps + 1; ++i) {
      const double sine = std::min(1.0, static_cast<double>(i) / AzimuthLobes::table_steps);
      lobes.table.push_back(static_cast<float>(lobe_above(along, z, power, sine) * scale));
    }
  }
}

}  // namespace

AzimuthSets make_azimuths(const HorizonGrid& by_rows, const HorizonGrid& by_columns,
                          const AzimuthOptions& options) {
  AzimuthSets sets{lay_azimuths(by_rows, options), lay_azimuths(by_columns, options)};
  std::vector<Spoke> spokes;
  add_spokes(spokes, sets.by_rows, false);
  add_spokes(spokes, sets.by_columns, true);

  std::array<double, SsbumpWeights::channels> whole{};
  const auto lobes = ssbump_lobes(options.power);
  for (const Spoke& spoke : spokes) {
    for (const Vec2& direction : spoke.directions) {
      for (std::size_t c = 0; c < lobes.size(); ++c) {
        const double along = lobes[c].axis.x * direction.x + lobes[c].axis.y * direction.y;
        whole[c] += spoke.angle * lobe_above(along, lobes[c].axis.z, lobes[c].power, 0);
      }
    }
  }
  for (const Spoke& spoke : spokes) {
    for (std::size_t way = 0; way < 2; ++way)
      weigh(spoke.azimuth->ways[way].lobes, spoke.directions[way], spoke.angle, options.power, whole);
  }
  return sets;
}

}  // namespace rnmbake
