// ssbump/horizon/line_hull.h - the upper hull of a line of heights, where all horizons of points on one side
// of it lie.
//
// Along a line only the points on the upper hull of all that lies ahead can be the horizon of anything behind
// them (Timonen and Westerholm, "Scalable Height Field Self-Shadowing", Eurographics 2010).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rnmbake {

struct LinePoint {
  std::int32_t at = 0;  // which step
  float height = 0;
};

/// Piece of a line between two steps.
struct LinePart {
  int from = 0, to = 0;
};

/// A stack of the hull's points, farthest first. There is always room for a vector's worth more.
class LineHull {
 public:
  static constexpr int most_at_once = 32;

  void clear() { count_ = 0; }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const std::int32_t* at() const { return at_.data(); }
  [[nodiscard]] const float* heights() const { return heights_.data(); }
  [[nodiscard]] std::int32_t* at_end() { return at_.data() + count_; }
  [[nodiscard]] float* heights_end() { return heights_.data() + count_; }

  /// Keeps the `count` farthest points.
  void keep(int count) { count_ = count; }
  /// Appends `count` points that the caller has written past the end.
  void append(int count) {
    count_ += count;
    make_room();
  }
  /// Pushes a point nearer than all others; pops those under the new hull.
  void push(const LinePoint& point);
  void make_room() {
    if (at_.size() < static_cast<std::size_t>(count_) + most_at_once) grow();
  }

 private:
  void grow();

  std::vector<std::int32_t> at_;
  std::vector<float> heights_;
  int count_ = 0;
};

/// 1 / |distance|, at a pointer that distances of either sign lead away from; 0 for 0.
class Reciprocals {
 public:
  explicit Reciprocals(int farthest);
  [[nodiscard]] const float* centre() const { return values_.data() + farthest_; }
  [[nodiscard]] int farthest() const { return farthest_; }

 private:
  int farthest_;
  std::vector<float> values_;
};

}  // namespace rnmbake
