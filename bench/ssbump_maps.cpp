#include "ssbump_maps.h"

#include "base/math.h"
#include "cobbles.h"
#include "ssbump/heights/read_heights.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

constexpr int side_length = 256, centre = side_length / 2;
constexpr double full_height = 32;  // of real ones, black to white

template <typename Function>
SsbumpMap map_of(std::string name, const Function& height) {
  SsbumpMap map{std::move(name), FloatImage(side_length, side_length, 1)};
  for (int y = 0; y < side_length; ++y)
    for (int x = 0; x < side_length; ++x) map.heights.texel(x, y)[0] = static_cast<float>(height(x, y));
  return map;
}

/// Mean over the square with corners at (left, top) and `side` texels farther.
double mean(const FloatImage& image, double left, double top, double side) {
  double sum = 0;
  for (int y = static_cast<int>(top); y < std::min<double>(top + side, image.height()); ++y) {
    for (int x = static_cast<int>(left); x < std::min<double>(left + side, image.width()); ++x) {
      const double across = std::min(left + side, x + 1.0) - std::max<double>(left, x);
      const double down = std::min(top + side, y + 1.0) - std::max<double>(top, y);
      sum += across * down * double{image.texel(x, y)[0]};
    }
  }
  return sum / (side * side);
}

SsbumpMap real_map(std::string name, const std::filesystem::path& file, const std::string& channel,
                   bool depths) {
  HeightOptions options;
  options.channel = channel;
  options.invert = depths;
  options.texels = full_height;
  const FloatImage heights = read_heights(file, options).field.heights;
  const double side = double(std::min(heights.width(), heights.height())) / side_length;
  return map_of(std::move(name), [&](int x, int y) { return mean(heights, x * side, y * side, side); });
}

}  // namespace

std::vector<SsbumpMap> generated_maps() {
  constexpr double radius = 64;
  const auto wave = [](int at) { return 8 * std::sin(2 * pi * at / 64); };
  return {
      map_of("flat", [](int, int) { return 0; }),
      map_of("tilt of 1/4 across, 1/8 down", [](int x, int y) { return 0.25 * x + 0.125 * y; }),
      map_of("hemisphere, radius 64",
             [](int x, int y) {
               const int u = x - centre, v = y - centre;
               return std::sqrt(std::max(0.0, radius * radius - u * u - v * v));
             }),
      map_of("V-groove, slope 1", [](int x, int) { return std::abs(x - centre); }),
      map_of("step of 16 texels", [](int x, int) { return x < centre ? 0 : 16; }),
      map_of("two sinusoids, together of 16 texels", [&](int x, int y) { return wave(x) + wave(y); }),
      map_of("fractal noise, range 48", [](int x, int y) { return 48 * fractal_noise(x, y, side_length); }),
      map_of("hard steps of 6 texels",
             [](int x, int y) { return 6 * std::floor(8 * fractal_noise(x, y, side_length)); }),
  };
}

std::vector<SsbumpMap> real_maps(const std::filesystem::path& folder) {
  return {
      real_map("cube, depth of 32 texels", folder / "cube/cube_depth.png", "", true),
      real_map("rock 023, 32 texels", folder / "rock023/rock023_alb_ht.png", "alpha", false),
      real_map("rock 058, 32 texels", folder / "rock058/displacement.jpg", "", false),
  };
}

}  // namespace rnmbake
