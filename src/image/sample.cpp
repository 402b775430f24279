#include "image/sample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rnmbake {
namespace {

/// UVs are floats: at 8192 texels a centre is off by up to 3e-4 texels. Graphics cards round to 1/256.
constexpr double snap = 1e-3;

/// Texel before and after a position along one axis, and the second one's weight.
struct Span {
  int before = 0, after = 0;
  float weight = 0;
};

Span span_at(double position, int size, Border border) {
  // Far outside, clamping gives the same texel and keeps the conversion to int defined.
  if (border == Border::clamp) position = std::clamp(position, -1.0, double(size));
  if (border == Border::wrap) position -= size * std::floor(position / size);
  double whole = std::floor(position), part = position - whole;
  if (part > 1 - snap) whole += 1;
  if (part < snap || part > 1 - snap) part = 0;
  const int i = static_cast<int>(whole);
  return {texel_within(i, size, border), texel_within(i + 1, size, border), static_cast<float>(part)};
}

}  // namespace

Vec2 texel_uv(const FloatImage& image, int x, int y) {
  return {static_cast<float>((x + 0.5) / image.width()), static_cast<float>(1 - (y + 0.5) / image.height())};
}

std::array<Tap, 4> bilinear_taps(const FloatImage& image, const Vec2& uv, Border border) {
  const Span x = span_at(double(uv.x) * image.width() - 0.5, image.width(), border);
  const Span y = span_at((1 - double(uv.y)) * image.height() - 0.5, image.height(), border);
  return {{{x.before, y.before, (1 - x.weight) * (1 - y.weight)},
           {x.after, y.before, x.weight * (1 - y.weight)},
           {x.before, y.after, (1 - x.weight) * y.weight},
           {x.after, y.after, x.weight * y.weight}}};
}

std::array<Tap, 4> covered_taps(std::array<Tap, 4> taps, const FloatImage& coverage) {
  float sum = 0;
  for (const Tap& tap : taps)
    if (coverage.texel(tap.x, tap.y)[0] > 0) sum += tap.weight;
  if (sum <= 0) return taps;
  for (Tap& tap : taps) tap.weight = coverage.texel(tap.x, tap.y)[0] > 0 ? tap.weight / sum : 0;
  return taps;
}

void sample(const FloatImage& image, const std::array<Tap, 4>& taps, std::span<float> out) {
  std::ranges::fill(out, 0.0F);
  for (const Tap& tap : taps) {
    if (tap.weight == 0) continue;
    const auto texel = image.texel(tap.x, tap.y);
    for (std::size_t c = 0; c < out.size(); ++c) out[c] += tap.weight * texel[c];
  }
}

Vec3 sampled_vec3(const FloatImage& image, const std::array<Tap, 4>& taps) {
  std::array<float, 3> values{};
  sample(image, taps, values);
  return {values[0], values[1], values[2]};
}

}  // namespace rnmbake
