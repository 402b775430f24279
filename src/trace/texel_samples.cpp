#include "trace/texel_samples.h"

#include "sampling/sampler.h"
#include "scene/uv_raster.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rnmbake {
namespace {

constexpr int most_tries = 10;  // as in Cycles; then the texel's centre

/// Interleaves bits, so that texels near each other get numbers near each other.
std::uint32_t morton(std::uint32_t x, std::uint32_t y) {
  const auto spread = [](std::uint32_t v) {
    v = (v | (v << 8)) & 0x00ff00ffU;
    v = (v | (v << 4)) & 0x0f0f0f0fU;
    v = (v | (v << 2)) & 0x33333333U;
    return (v | (v << 1)) & 0x55555555U;
  };
  return spread(x) | (spread(y) << 1);
}

float footprint_side(Footprint footprint) {
  return footprint == Footprint::centre ? 0.0F : footprint == Footprint::half ? 0.5F : 1.0F;
}

/// Folds a number into [0, limit] like a strip of paper.
float fold(float value, float limit) {
  if (value >= 0 && value <= limit) return value;
  if (!(limit > 0)) return 0;
  const float turns = value / limit, whole = std::floor(turns), rest = turns - whole;
  return (static_cast<int>(whole) & 1) != 0 ? (1 - rest) * limit : rest * limit;
}

/// The next of a pseudo-random sequence of pairs.
Vec2 another(const Vec2& u) {
  const std::uint64_t bits = hash_of(std::bit_cast<std::uint32_t>(u.x), std::bit_cast<std::uint32_t>(u.y));
  const auto unit = [](std::uint64_t x) { return static_cast<float>(x & 0xffffffU) * 0x1p-24F; };
  return {unit(bits >> 32), unit(bits)};
}

}  // namespace

TexelSamples::TexelSamples(const Surface& surface, int width, int height, Footprint footprint,
                           PastEdge past_edge)
    : surface_(surface), past_edge_(past_edge) {
  std::vector<Vec2> uv;
  uv.reserve(3 * surface.triangles.size());
  for (const SurfaceTriangle& triangle : surface.triangles) {
    for (const SurfaceCorner& corner : triangle.corners) uv.push_back(corner.uv);
  }
  const UvRaster raster = rasterize(uv, width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const TexelOwner& owner = raster.at(x, y);
      if (owner.triangle < 0) continue;
      texels_.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                         static_cast<std::uint32_t>(owner.triangle), owner.b1, owner.b2});
    }
  }
  std::sort(texels_.begin(), texels_.end(),
            [](const TexelSample& a, const TexelSample& b) { return morton(a.x, a.y) < morton(b.x, b.y); });

  const float side = footprint_side(footprint);
  slopes_.resize(surface.triangles.size());
  for (std::size_t t = 0; t < slopes_.size(); ++t) {
    const Vec2 e1 = uv[3 * t + 1] - uv[3 * t], e2 = uv[3 * t + 2] - uv[3 * t];
    const float area = e1.x * e2.y - e1.y * e2.x;
    if (area == 0) continue;
    const float du = side / static_cast<float>(width), dv = side / static_cast<float>(height);
    slopes_[t] = {Vec2(e2.y, -e1.y) * (du / area), Vec2(-e2.x, e1.x) * (dv / area)};
  }
}

Vec3 TexelSamples::mirrored(const TexelSample& texel, const Vec2& u) const {
  const Vec2 weights = slopes_[texel.triangle].barycentric(texel, u);
  // Cycles' order: the coordinate of corner 0 within 1, that of corner 1 within the remainder, corner 2 has
  // the rest.
  const float b0 = fold(1 - weights.x - weights.y, 1), b1 = fold(weights.x, 1 - b0);
  return {b0, b1, std::max(0.0F, 1 - b0 - b1)};
}

Vec3 TexelSamples::retried(const TexelSample& texel, Vec2 u) const {
  for (int i = 0; i < most_tries; ++i) {
    const Vec2 weights = slopes_[texel.triangle].barycentric(texel, u);
    const float b0 = 1 - weights.x - weights.y;
    if (weights.x > 0 && weights.y > 0 && b0 > 0) return {b0, weights.x, weights.y};
    u = another(u);
  }
  return {1 - texel.b1 - texel.b2, texel.b1, texel.b2};
}

GatherPoint TexelSamples::sample(std::size_t index, const Vec2& u) const {
  const TexelSample& texel = texels_[index];
  GatherPoint point;
  point.triangle = texel.triangle;
  point.barycentric = past_edge_ == PastEdge::mirror ? mirrored(texel, u) : retried(texel, u);
  const Vec3& b = point.barycentric;
  const SurfaceTriangle& triangle = surface_.triangles[texel.triangle];
  const auto& corners = triangle.corners;
  point.position = corners[0].position * b.x + corners[1].position * b.y + corners[2].position * b.z;
  point.face = triangle.normal;
  const auto interpolated = [&](Vec3 Frame::*axis) {
    return corners[0].frame.*axis * b.x + corners[1].frame.*axis * b.y + corners[2].frame.*axis * b.z;
  };
  point.frame = {interpolated(&Frame::tangent), interpolated(&Frame::bitangent), interpolated(&Frame::normal),
                 corners[0].frame.sign};
  return point;
}

}  // namespace rnmbake
