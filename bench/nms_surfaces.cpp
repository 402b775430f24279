#include "nms_surfaces.h"

#include "image/layered_exr.h"
#include "ssbump/map/normal_map.h"
#include "ssbump/map/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace rnmbake {
namespace {

constexpr int side_length = 256;

Case with_own_normals(std::string name, FloatImage heights) {
  Case result{std::move(name), {std::move(heights)}, {}, {}};
  result.walked = result.normals = height_normals(result.field, 0, result.field.height());
  return result;
}

FloatImage heights_of(const std::function<double(double, double)>& height) {
  FloatImage heights(side_length, side_length, 1);
  for (int y = 0; y < side_length; ++y)
    for (int x = 0; x < side_length; ++x) heights.texel(x, y)[0] = static_cast<float>(height(x, y));
  return heights;
}

/// Distance from the middle of a square of `pitch` texels, along one axis.
double from_middle(double at, double pitch) {
  return std::fmod(at, pitch) - pitch / 2;
}

double sinusoid(double x, double y) {
  return 8 * std::sin(2 * pi * x / 64) * std::sin(2 * pi * y / 64);
}

double hemisphere(double x, double y) {
  const double u = from_middle(x, 64), v = from_middle(y, 64);
  return std::sqrt(std::max(0.0, 20.0 * 20 - u * u - v * v));
}

double groove(double x, double /*y*/) {
  return std::min(0.0, std::abs(from_middle(x, 64)) - 12);
}

double block(double x, double y) {
  return std::abs(from_middle(x, 64)) < 16 && std::abs(from_middle(y, 64)) < 16 ? 8 : 0;
}

/// Sums of waves that fit the map, the amplitude falling with the frequency.
FloatImage fractal() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> phase(0, 2 * pi);
  FloatImage heights(side_length, side_length, 1);
  for (int u = -24; u <= 24; ++u) {
    for (int v = 0; v <= 24; ++v) {
      const double frequency = std::hypot(u, v), start = phase(random);
      if (frequency < 2) continue;
      const double amplitude = 24 / std::pow(frequency, 1.9);
      for (int y = 0; y < side_length; ++y)
        for (int x = 0; x < side_length; ++x)
          heights.texel(x, y)[0] +=
              static_cast<float>(amplitude * std::cos(2 * pi * (u * x + v * y) / side_length + start));
    }
  }
  return heights;
}

FloatImage scaled(FloatImage heights, float factor) {
  for (float& height : heights.data()) height *= factor;
  return heights;
}

/// Means over squares, so that the smaller side has side_length texels or a little more.
FloatImage reduced(const FloatImage& image) {
  const int by = std::max(1, std::min(image.width(), image.height()) / side_length);
  FloatImage result(image.width() / by, image.height() / by, image.channels());
  const float share = 1 / static_cast<float>(by * by);
  for (int y = 0; y < result.height() * by; ++y) {
    for (int x = 0; x < result.width() * by; ++x) {
      const auto from = image.texel(x, y);
      const auto to = result.texel(x / by, y / by);
      for (std::size_t c = 0; c < from.size(); ++c) to[c] += share * from[c];
    }
  }
  return result;
}

FloatImage renormalised(FloatImage normals) {
  for (int y = 0; y < normals.height(); ++y) {
    for (int x = 0; x < normals.width(); ++x) {
      const auto n = normals.texel(x, y);
      const Vec3 normal = unit(Vec3(n[0], n[1], n[2]));
      std::ranges::copy(std::array{normal.x, normal.y, normal.z}, n.begin());
    }
  }
  return normals;
}

}  // namespace

std::vector<Case> generated_surfaces() {
  std::vector<Case> cases;
  cases.push_back(with_own_normals("flat", heights_of([](double, double) { return 0; })));
  for (const float factor : {0.25F, 1.0F, 4.0F})
    cases.push_back(
        with_own_normals(fmt::format("sinusoid x{:g}", factor), scaled(heights_of(sinusoid), factor)));
  for (const float factor : {0.25F, 1.0F, 4.0F})
    cases.push_back(with_own_normals(fmt::format("fractal x{:g}", factor), scaled(fractal(), factor)));
  cases.push_back(with_own_normals("V-grooves", heights_of(groove)));
  cases.push_back(with_own_normals("hemispheres", heights_of(hemisphere)));
  cases.push_back(with_own_normals("blocks (hard steps)", heights_of(block)));
  return cases;
}

double slope_rms(const Case& one) {
  const FloatImage normals = height_normals(one.field, 0, one.field.height());
  double squares = 0;
  for (std::size_t i = 2; i < normals.data().size(); i += 3)
    squares += 1 / std::pow(normals.data()[i], 2) - 1;
  return std::sqrt(squares / static_cast<double>(normals.texels()));
}

Published published(const std::filesystem::path& heights_file, std::size_t channel,
                    const std::filesystem::path& normals_file, const std::string& name, float sign) {
  const LayeredImage picture = read_image(heights_file);
  const FloatImage& pixels = picture.find("")->pixels;
  FloatImage heights(pixels.width(), pixels.height(), 1);
  for (std::size_t i = 0; i < heights.texels(); ++i)
    heights.data()[i] = sign * pixels.data()[i * static_cast<std::size_t>(pixels.channels()) + channel];
  heights = reduced(heights);
  FloatImage normals =
      renormalised(reduced(unit_normals(read_image(normals_file), normals_file.string(), {})));
  const FloatImage unscaled = height_normals({heights}, 0, heights.height());
  double products = 0, squares = 0, normal_squares = 0;
  for (int y = 0; y < heights.height(); ++y) {
    for (int x = 0; x < heights.width(); ++x) {
      const std::span<const float> a = unscaled.texel(x, y), b = normals.texel(x, y);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double slope = a[axis] / a[2], wanted = b[axis] / std::max(b[2], 0.05F);
        products += slope * wanted;
        squares += slope * slope;
        normal_squares += wanted * wanted;
      }
    }
  }
  const auto scale = static_cast<float>(products / squares);
  Published result{
      with_own_normals(name, scaled(heights, scale)), {}, products / std::sqrt(squares * normal_squares)};
  result.theirs = {name + ", its own normal map", result.own.field, normals, normals};
  return result;
}

FloatImage flipped_green(FloatImage normals) {
  for (std::size_t i = 1; i < normals.data().size(); i += 3) normals.data()[i] = -normals.data()[i];
  return normals;
}

FloatImage eight_bit(FloatImage normals) {
  for (float& value : normals.data()) value = 2 * std::round(255 * (value + 1) / 2) / 255 - 1;
  return renormalised(std::move(normals));
}

}  // namespace rnmbake
