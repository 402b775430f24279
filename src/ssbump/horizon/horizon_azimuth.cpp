#include "ssbump/horizon/horizon_azimuth.h"

#include "ssbump/map/lobes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace rnmbake {
namespace {

/// The plane's directions in tangent space of one azimuth's two ways, the angle from the rows, and the angle
/// that it stands for.
struct Spoke {
  Azimuth* azimuth;
  std::array<Vec2, 2> directions;
  double at = 0, angle = 0;
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

/// Ray from a texel's centre: |slope| lines aside, to one side, for each step.
class NearWay {
 public:
  NearWay(double slope, int sign, std::ptrdiff_t pitch)
      : steep_(std::abs(slope)), side_(sign * slope < 0 ? -1 : 1), forward_(sign * pitch) {}

  [[nodiscard]] int side() const { return side_; }
  [[nodiscard]] float steep() const { return static_cast<float>(steep_); }

  [[nodiscard]] RowCrossing crossing(int row) const {
    const double aside = row * steep_, line = std::floor(aside);
    return {texel(row, static_cast<int>(line)), static_cast<float>(aside - line)};
  }

  /// Part of the ray from a row to the next.
  [[nodiscard]] NearStep step(int row) const {
    const double from = row * steep_, to = (row + 1) * steep_, line = std::floor(from);
    NearStep step;
    step.row = {texel(row + 1, static_cast<int>(line)), static_cast<float>(to - line)};
    step.per_height = static_cast<float>(1.0 / (row + 1));
    step.crosses = to >= line + 1;
    if (!step.crosses) {
      step.middle = middle(row, row + 1.0);
      return step;
    }
    const double way = std::min((line + 1) / steep_, row + 1.0);  // where it crosses
    step.last = texel(row, static_cast<int>(line) + 2);
    step.cross_part = static_cast<float>(way - row);
    step.cross_per_height = static_cast<float>(1 / way);
    step.row.part = static_cast<float>(to - line - 1);
    step.middle = middle(row, way);
    step.second_middle = middle(way, row + 1.0);
    return step;
  }

 private:
  [[nodiscard]] std::ptrdiff_t texel(int row, int line) const {
    return row * forward_ + static_cast<std::ptrdiff_t>(line) * side_;
  }
  /// Middle of a patch. In the first patch the steepest slope is at one of its ends.
  [[nodiscard]] NearStep::Middle middle(double from, double to) const {
    const double length = to - from, at = (from + to) / 2;
    if (from == 0 || steep_ * length * length / 4 < least_bend * at) return {};
    return {true, static_cast<float>(-steep_ * length * length / 4), static_cast<float>(1 / at)};
  }

  double steep_;
  int side_;
  std::ptrdiff_t forward_;  // in memory, for a step
};

Azimuth make_azimuth(const HorizonGrid& grid, double slope, int near_rows) {
  Azimuth azimuth;
  azimuth.slope = slope;
  lay_lines(azimuth, grid.steps);
  for (const int sign : {1, -1}) {
    Azimuth::Way& way = azimuth.ways[sign > 0 ? 0 : 1];
    const NearWay near(azimuth.slope, sign, grid.pitch);
    way.side = near.side();
    way.steep = near.steep();
    for (int row = 0; row < near_rows; ++row) way.near.push_back(near.step(row));
    way.beyond = near.crossing(near_rows + 1);
  }
  return azimuth;
}

/// Adds both directions of each azimuth. By columns the first leads along the row (x rises), by rows up the
/// picture's rows (y falls).
void add_spokes(std::vector<Spoke>& spokes, std::vector<Azimuth>& set, bool by_columns) {
  for (Azimuth& azimuth : set) {
    const double slope = azimuth.slope, length = std::sqrt(1 + slope * slope);
    const double right = by_columns ? 1 / length : slope / length, up = (by_columns ? -slope : -1) / length;
    const Vec2 forth(static_cast<float>(right), static_cast<float>(up));
    double at = std::atan2(up, right);
    if (at < 0) at += pi;
    spokes.push_back({&azimuth, {forth, -forth}, at >= pi ? at - pi : at});
  }
}

void share_angles(std::vector<Spoke>& spokes) {
  std::ranges::sort(spokes, {}, &Spoke::at);
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    const Spoke &before = spokes[i > 0 ? i - 1 : spokes.size() - 1], &after = spokes[(i + 1) % spokes.size()];
    const double from = i > 0 ? before.at : before.at - pi,
                 to = i + 1 < spokes.size() ? after.at : after.at + pi;
    spokes[i].angle = (to - from) / 2;
  }
}

/// `whole`: sums of the open sky over these azimuths, for each channel.
void weigh(AzimuthLobes& lobes, const Vec2& direction, double angle, double power,
           const std::array<double, SsbumpWeights::channels>& whole) {
  const auto all = ssbump_lobes(power);
  for (std::size_t c = 0; c < all.size(); ++c) {
    const double along = all[c].axis.x * direction.x + all[c].axis.y * direction.y, z = all[c].axis.z;
    const double scale = angle / whole[c];
    AzimuthLobes::Linear& linear = lobes.linear[c];
    linear.along = static_cast<float>(along * scale / 2);
    linear.up = static_cast<float>(z * scale / 2);
    linear.begins = along < 0 ? static_cast<float>(-along / std::hypot(along, z)) : -1.0F;
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
  AzimuthSets sets;
  const int count = (options.azimuths + 1) / 2;
  for (int i = 0; i < count; ++i) {
    const double angle = pi * (i + options.offset) / count, right = std::cos(angle), up = std::sin(angle);
    if (std::abs(up) >= std::abs(right))  // rows are counted down the picture
      sets.by_rows.push_back(make_azimuth(by_rows, -right / up, options.near_rows));
    else
      sets.by_columns.push_back(make_azimuth(by_columns, -up / right, options.near_rows));
  }
  std::vector<Spoke> spokes;
  add_spokes(spokes, sets.by_rows, false);
  add_spokes(spokes, sets.by_columns, true);
  share_angles(spokes);

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
