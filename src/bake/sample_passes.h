// bake/sample_passes.h - a bake cut into passes: ranges of the samples of two independent sequences.
//
// Passes with consecutive ranges of one sequence have together the mean and the variance of one bake of all
// samples (docs/passes.md). Two sequences, the halves, have seeds of their own: their difference says how
// noisy a bake is.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace rnmbake {

/// Samples [first, first + count) of a half, of the `of` that it will have.
struct SamplePass {
  int half = 0;  // 0 or 1
  int first = 0, count = 0, of = 0;
  bool operator==(const SamplePass&) const = default;
};

/// Samples of each half.
using HalfSamples = std::array<int, 2>;

/// Halves of so many samples; the first has the odd one.
[[nodiscard]] HalfSamples in_halves(int samples);

/// Cycles' seed of a half. The first has the user's own.
[[nodiscard]] int seed_of_half(int seed, int half);

/// What a pass costs, by a model of a machine of two cores (docs/performance.md): the same everywhere,
/// because it decides how a bake is cut, and with that the last digits of its result.
struct PassCost {
  double fixed_seconds = 0;   // before the first sample
  double sample_seconds = 0;  // of one sample of all texels
};
[[nodiscard]] PassCost model_cost(std::int64_t covered_texels, std::int64_t receiver_triangles,
                                  std::int64_t scene_triangles);

/// Passes from `done` to `wanted`, half by half in turns: each long enough that its fixed cost is at most a
/// twentieth of it, and short enough that little is lost where it is cut off. Their number grows with the
/// logarithm of the samples: the cut does not depend on `wanted`, but for the last pass.
[[nodiscard]] std::vector<SamplePass> cut_into_passes(const HalfSamples& done, const HalfSamples& wanted,
                                                      const PassCost& cost);

}  // namespace rnmbake
