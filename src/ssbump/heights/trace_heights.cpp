#include "ssbump/heights/trace_heights.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

constexpr int most_cells = 65536;
constexpr double off_surface = 1e-6;  // of the heights' range and a texel: so far rays begin over it

/// One axis of a walk.
struct Track {
  double start, speed;
  int cell;

  Track(double from, double per_way)
      : start(from),
        speed(per_way),
        cell(static_cast<int>(per_way < 0 ? std::ceil(from) - 1 : std::floor(from))) {}
  /// The way to the cell's far side.
  [[nodiscard]] double leave() const {
    if (speed == 0) return HUGE_VAL;
    return (cell + (speed > 0 ? 1 : 0) - start) / speed;
  }
  [[nodiscard]] double within(double way) const { return start + speed * way - cell; }
  void step() { cell += speed > 0 ? 1 : -1; }
};

/// The first t in [from, to] where c0 + c1 t + c2 t^2 falls below 0; negative: it does not.
double first_below(double c0, double c1, double c2, double from, double to) {
  const auto value = [&](double t) { return c0 + t * (c1 + t * c2); };
  if (value(from) < 0) return from;
  const double root = c1 * c1 - 4 * c2 * c0;
  if (root < 0) return -1;
  const double q = -(c1 + std::copysign(std::sqrt(root), c1)) / 2;
  double best = -1;
  for (const double t : {c2 != 0 ? q / c2 : -1.0, q != 0 ? c0 / q : -1.0}) {
    const bool falls = c1 + 2 * c2 * t < 0;
    if (falls && t >= from && t <= to && (best < 0 || t < best)) best = t;
  }
  return best < 0 && value(to) < 0 ? to : best;
}

}  // namespace

HeightTracer::HeightTracer(const HeightField& field)
    : field_(field), highest_(*std::ranges::max_element(field.heights.data())) {}

double HeightTracer::height(int x, int y) const {
  return field_.heights.texel(texel_beyond(x, field_.width(), field_.x),
                              texel_beyond(y, field_.height(), field_.y))[0];
}

HeightTracer::Patch HeightTracer::patch(int x, int y) const {
  const double h = height(x, y), right = height(x + 1, y), down = height(x, y + 1);
  return {h, right - h, down - h, height(x + 1, y + 1) - right - down + h};
}

HeightPlace HeightTracer::centre(int x, int y) const {
  return {static_cast<double>(x), static_cast<double>(y), height(x, y)};
}

std::pair<int, int> HeightTracer::texel(const HeightPlace& place) const {
  return {texel_beyond(static_cast<int>(std::lround(place.column)), field_.width(), field_.x),
          texel_beyond(static_cast<int>(std::lround(place.row)), field_.height(), field_.y)};
}

std::optional<HeightHit> HeightTracer::next(const HeightPlace& from, const Vec3d& direction) const {
  if (direction.x == 0 && direction.y == 0) return std::nullopt;
  const double begin = from.height + off_surface * (1 + std::abs(from.height));
  Track x(from.column, direction.x), y(from.row, -direction.y);  // rows run down
  double way = 0;
  for (int cells = 0; cells < most_cells; ++cells) {
    if (direction.z >= 0 && begin + direction.z * way > highest_) return std::nullopt;
    const double leave = std::max(way, std::min(x.leave(), y.leave()));
    const Patch p = patch(x.cell, y.cell);
    const double u = x.within(0), v = y.within(0);
    const double c0 = begin - (p.h + p.by_u * u + p.by_v * v + p.by_uv * u * v);
    const double c1 =
        direction.z - (p.by_u * x.speed + p.by_v * y.speed + p.by_uv * (u * y.speed + v * x.speed));
    const double t = first_below(c0, c1, -p.by_uv * x.speed * y.speed, way, leave);
    if (t >= 0) {
      const Vec3d normal(-(p.by_u + p.by_uv * y.within(t)), p.by_v + p.by_uv * x.within(t), 1);
      return HeightHit{{from.column + x.speed * t, from.row + y.speed * t, begin + direction.z * t},
                       normal.normalized()};
    }
    (x.leave() <= y.leave() ? x : y).step();
    way = leave;
  }
  return std::nullopt;
}

}  // namespace rnmbake
