#include "ssbump/heights/height_shadows.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

constexpr int disc_directions_count = 64;

double height_at(const HeightField& field, int x, int y) {
  return field.heights.texel(texel_beyond(x, field.width(), field.x),
                             texel_beyond(y, field.height(), field.y))[0];
}

/// One axis of a walk over the grid of texel centres, begun on a grid point.
class Axis {
 public:
  Axis(int start, double speed) : start_(start), speed_(speed), cell_(speed < 0 ? start - 1 : start) {}

  [[nodiscard]] int cell() const { return cell_; }
  [[nodiscard]] double speed() const { return speed_; }
  [[nodiscard]] double next_line() const { return speed_ == 0 ? HUGE_VAL : lines_ / std::abs(speed_); }
  /// Place within the cell, in [0, 1].
  [[nodiscard]] double part(double distance) const {
    return std::clamp(start_ - cell_ + speed_ * distance, 0.0, 1.0);
  }
  /// Whether heights no longer change along this axis, from this cell to the walk's end.
  [[nodiscard]] bool is_over(int size, WrapMode beyond) const {
    if (speed_ == 0) return true;
    return beyond == WrapMode::none && (speed_ > 0 ? cell_ >= size - 1 : cell_ < 0);
  }
  void step() {
    cell_ += speed_ < 0 ? -1 : 1;
    lines_ += 1;
  }

 private:
  int start_;
  double speed_;
  int cell_;
  double lines_ = 1;  // a count, so that no error adds up
};

/// Height over the start along a ray within one patch, by the distance t from the start: c0 + c1 t + c2 t^2.
struct Parabola {
  double c0 = 0, c1 = 0, c2 = 0;

  /// Largest slope (height over distance) in [from, to], but for the point `from`, unless it is 0: there the
  /// slope is the derivative.
  [[nodiscard]] double steepest(double from, double to) const {
    const auto slope = [&](double t) { return c0 / t + c1 + c2 * t; };
    if (from == 0) return std::max(c1, c1 + c2 * to);
    double best = slope(to);
    if (c0 < 0 && c2 < 0) {
      const double top = std::sqrt(c0 / c2);
      if (top > from && top < to) best = std::max(best, slope(top));
    }
    return best;
  }
};

Parabola over_patch(const HeightField& field, const Axis& x, const Axis& y, double from,
                    double start_height) {
  const double h00 = height_at(field, x.cell(), y.cell()) - start_height;
  const double by_u = height_at(field, x.cell() + 1, y.cell()) - start_height - h00;
  const double by_v = height_at(field, x.cell(), y.cell() + 1) - start_height - h00;
  const double by_uv = height_at(field, x.cell() + 1, y.cell() + 1) - start_height - h00 - by_u - by_v;
  const double u = x.part(from), v = y.part(from);
  const double at = h00 + by_u * u + by_v * v + by_uv * u * v;
  const double rise = by_u * x.speed() + by_v * y.speed() + by_uv * (u * y.speed() + v * x.speed());
  const double bend = by_uv * x.speed() * y.speed();
  if (from == 0) return {0, rise, bend};
  return {at - rise * from + bend * from * from, rise - 2 * bend * from, bend};
}

/// Directions spread evenly over a cap of the sphere (Fibonacci's spiral), unit.
std::vector<Vec3> disc_directions(const Vec3& centre, double radius) {
  if (radius <= 0) return {centre};
  const Vec3 aside = std::abs(centre.x) < 0.5F ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 u = unit(centre.cross(aside)), v = centre.cross(u);
  const double golden = pi * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int i = 0; i < disc_directions_count; ++i) {
    const double cosine = 1 - (1 - std::cos(radius)) * (i + 0.5) / disc_directions_count;
    const double sine = std::sqrt(1 - cosine * cosine);
    directions.push_back(unit(centre * static_cast<float>(cosine) +
                              u * static_cast<float>(sine * std::cos(golden * i)) +
                              v * static_cast<float>(sine * std::sin(golden * i))));
  }
  return directions;
}

}  // namespace

HeightRays::HeightRays(const HeightField& field)
    : field_(field), highest_(*std::ranges::max_element(field.heights.data())) {}

double HeightRays::steepest(int x, int y, const Vec2& azimuth, double floor, Until until) const {
  const double start = height_at(field_, x, y);
  Axis along_x(x, azimuth.x), along_y(y, -azimuth.y);  // rows run down
  double best = floor, from = 0;
  int repeating = 0;  // lines of one axis, since the other is over
  while (from * best <= highest_ - start) {
    const double to = std::min(along_x.next_line(), along_y.next_line());
    if (to > from)
      best = std::max(best, over_patch(field_, along_x, along_y, from, start).steepest(from, to));
    if (until == Until::first_above && best > floor) break;
    const bool x_is_over = along_x.is_over(field_.width(), field_.x);
    const bool y_is_over = along_y.is_over(field_.height(), field_.y);
    if (x_is_over && y_is_over) break;
    const bool crosses_x = along_x.next_line() <= along_y.next_line();
    (crosses_x ? along_x : along_y).step();
    if (crosses_x ? y_is_over : x_is_over) {  // the remaining heights repeat, farther away
      if (++repeating > 2 * (crosses_x ? field_.width() : field_.height())) break;
    }
    from = to;
  }
  return best;
}

double HeightRays::horizon_slope(int x, int y, const Vec2& azimuth, double floor) const {
  return steepest(x, y, azimuth, floor, Until::end);
}

bool HeightRays::occluded(int x, int y, const Vec3& light) const {
  if (light.z <= 0) return true;
  const float along = std::hypot(light.x, light.y);
  if (along == 0) return false;
  const double slope = double(light.z) / along;
  return steepest(x, y, Vec2(light.x, light.y) / along, slope, Until::first_above) > slope;
}

FloatImage height_shadows(const HeightField& field, const Vec3& light, double angular_radius) {
  const HeightRays rays(field);
  const std::vector<Vec3> directions = disc_directions(light, angular_radius);
  FloatImage seen(field.width(), field.height(), 1);
  tbb::parallel_for(0, field.height(), [&](int y) {
    for (int x = 0; x < field.width(); ++x) {
      const auto free =
          std::ranges::count_if(directions, [&](const Vec3& d) { return !rays.occluded(x, y, d); });
      seen.texel(x, y)[0] = static_cast<float>(free) / static_cast<float>(directions.size());
    }
  });
  return seen;
}

}  // namespace rnmbake
