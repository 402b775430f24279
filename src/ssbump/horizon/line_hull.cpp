#include "ssbump/horizon/line_hull.h"

#include <cmath>

namespace rnmbake {

void LineHull::grow() {
  const auto needed = 2 * static_cast<std::size_t>(count_ + most_at_once);
  at_.resize(needed);
  heights_.resize(needed);
}

void LineHull::push(const LinePoint& point) {
  make_room();
  const auto top = [&](int below) { return static_cast<std::size_t>(count_ - 1 - below); };
  while (count_ > 1) {
    const float to_top = heights_[top(0)] - point.height, to_next = heights_[top(1)] - point.height;
    const auto way_top = static_cast<float>(std::abs(at_[top(0)] - point.at));
    const auto way_next = static_cast<float>(std::abs(at_[top(1)] - point.at));
    if (to_top * way_next > to_next * way_top) break;
    --count_;
  }
  *at_end() = point.at;
  *heights_end() = point.height;
  ++count_;
}

Reciprocals::Reciprocals(int farthest) : farthest_(farthest) {
  values_.resize(2 * static_cast<std::size_t>(farthest) + 1);
  float* const middle = values_.data() + farthest;
  for (int i = 1; i <= farthest; ++i) middle[i] = middle[-i] = 1 / static_cast<float>(i);
}

}  // namespace rnmbake
