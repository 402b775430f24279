// tests/trace/moments.h - mean, standard deviation and standard error of a few numbers.
#pragma once

#include "base/numeric/running_moments.h"

#include <cmath>

namespace rnmbake {

class Moments {
 public:
  void add(double value) { moments_.add(value, ++count_); }
  [[nodiscard]] double mean() const { return moments_.mean; }
  [[nodiscard]] double spread() const { return std::sqrt(moments_.squares / (count_ - 1)); }
  [[nodiscard]] double error() const { return spread() / std::sqrt(count_); }

 private:
  double count_ = 0;
  RunningMoments<double> moments_;
};

}  // namespace rnmbake
