// tests/trace/moments.h - mean, spread and standard error of a few numbers.
#pragma once

#include <algorithm>
#include <cmath>

namespace rnmbake {

class Moments {
 public:
  void add(double value) {
    ++count_;
    sum_ += value;
    squares_ += value * value;
  }
  [[nodiscard]] double mean() const { return sum_ / count_; }
  [[nodiscard]] double spread() const {
    return std::sqrt(std::max(0.0, squares_ / count_ - mean() * mean()) * count_ / (count_ - 1));
  }
  [[nodiscard]] double error() const { return spread() / std::sqrt(count_); }

 private:
  double count_ = 0, sum_ = 0, squares_ = 0;
};

}  // namespace rnmbake
