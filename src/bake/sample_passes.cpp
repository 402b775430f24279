#include "bake/sample_passes.h"

#include <algorithm>

namespace rnmbake {
namespace {

constexpr double shortest_seconds = 10, least_share = 20;  // of a pass; of it in its fixed cost

/// A pass has at least the largest power of two within an eighth of the samples before it: every pass is a
/// picture to keep and to add up, and where one sample of a large atlas takes longer than the shortest pass
/// there would be one for each.
constexpr int least_growth = 8;

/// Samples of a pass after `before` that is neither too short nor too dear: a power of two, which suits
/// Sobol's sequence.
int samples_of_pass(const PassCost& cost, int before) {
  const double seconds = std::max(shortest_seconds, least_share * cost.fixed_seconds);
  int samples = 1;
  while (samples < (1 << 24) &&
         (samples * cost.sample_seconds < seconds || samples * 2 <= before / least_growth))
    samples *= 2;
  return samples;
}

}  // namespace

HalfSamples in_halves(int samples) {
  return {samples - samples / 2, samples / 2};
}

int seed_of_half(int seed, int half) {
  if (half == 0) return seed;
  // Weyl's sequence: far from the seeds next to the user's, which he may bake with as well.
  return static_cast<int>((static_cast<std::uint32_t>(seed) + 0x9E3779B9U) & 0x7FFFFFFFU);
}

PassCost model_cost(std::int64_t covered_texels, std::int64_t receiver_triangles,
                    std::int64_t scene_triangles) {
  return {0.3 + 8e-6 * double(receiver_triangles) + 2e-6 * double(scene_triangles),
          3e-6 * double(covered_texels)};
}

std::vector<SamplePass> cut_into_passes(const HalfSamples& done, const HalfSamples& wanted,
                                        const PassCost& cost) {
  std::vector<SamplePass> passes;
  HalfSamples next = done;
  while (next[0] < wanted[0] || next[1] < wanted[1]) {
    for (const int half : {0, 1}) {
      int& first = next[std::size_t(half)];
      const int end = wanted[std::size_t(half)];
      if (first >= end) continue;
      const int length = samples_of_pass(cost, first), left = end - first;
      const int count = left < length + length / 2 ? left : length;
      passes.push_back({half, first, count, end});
      first += count;
    }
  }
  return passes;
}

}  // namespace rnmbake
