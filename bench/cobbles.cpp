#include "cobbles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

constexpr int stone_side = 64, octaves = 6;
constexpr double roughness = 0.35;  // of the noise, beside the stones

/// In [0, 1), for a point of a grid.
double random_at(int x, int y, std::uint32_t salt) {
  std::uint32_t h =
      static_cast<std::uint32_t>(x) * 0x9E3779B1U + static_cast<std::uint32_t>(y) * 0x85EBCA77U + salt;
  for (const std::uint32_t factor : {0x7FEB352DU, 0x846CA68BU}) h = (h ^ (h >> 15)) * factor;
  return (h ^ (h >> 16)) * 0x1p-32;
}

/// Values at the points of a grid of `cells` x `cells`, smooth between them.
double noise(double x, double y, int cells, std::uint32_t salt) {
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
  const double u = smooth(x - column), v = smooth(y - row);
  const auto at = [&](int i, int j) { return random_at((column + i) % cells, (row + j) % cells, salt); };
  return std::lerp(std::lerp(at(0, 0), at(1, 0), u), std::lerp(at(0, 1), at(1, 1), u), v);
}

/// A stone about every point of a grid that is shaken: high in the middle, steep where the next one begins.
double stones(int x, int y, int side) {
  const int cells = side / stone_side, column = x / stone_side, row = y / stone_side;
  double nearest = HUGE_VAL, next = HUGE_VAL;
  for (int j = row - 1; j <= row + 1; ++j) {
    for (int i = column - 1; i <= column + 1; ++i) {
      const int a = (i + cells) % cells, b = (j + cells) % cells;
      const double dx = double(x) / stone_side - i - 0.2 - 0.6 * random_at(a, b, 101);
      const double dy = double(y) / stone_side - j - 0.2 - 0.6 * random_at(a, b, 102);
      const double distance = std::hypot(dx, dy);
      next = std::min(next, std::max(nearest, distance));
      nearest = std::min(nearest, distance);
    }
  }
  return std::sqrt(std::min(1.0, 2 * (next - nearest)));
}

}  // namespace

double fractal_noise(int x, int y, int side) {
  double sum = 0, size = 0.5;
  for (int octave = 0, pitch = stone_side; octave < octaves; ++octave, pitch /= 2, size /= 2)
    sum +=
        size * noise(double(x) / pitch, double(y) / pitch, side / pitch, static_cast<std::uint32_t>(octave));
  return sum;
}

HeightField cobbles(int side, float range) {
  HeightField field{FloatImage(side, side, 1)};
  tbb::parallel_for(0, side, [&](int y) {
    for (int x = 0; x < side; ++x)
      field.heights.texel(x, y)[0] =
          static_cast<float>(stones(x, y, side) + roughness * fractal_noise(x, y, side));
  });
  std::vector<float>& heights = field.heights.data();
  const auto [low, high] = std::ranges::minmax(heights);
  for (float& height : heights) height = range * (height - low) / (high - low);
  return field;
}

}  // namespace rnmbake
