#include "ssbump/mesh/low_texels.h"

#include "scene/uv_raster.h"

#include <algorithm>
#include <map>
#include <utility>

namespace rnmbake {
namespace {

/// Rows of a picture, in its own texels.
struct Rows {
  int first, count, of;

  /// Maps v of the whole picture to the band's.
  [[nodiscard]] float v(float whole) const {
    return static_cast<float>((double{whole} * of - (of - first - count)) / count);
  }
};

UvRaster raster_of(const Surface& surface, int width, const Rows& rows) {
  std::vector<Vec2> uv;
  uv.reserve(3 * surface.triangles.size());
  for (const SurfaceTriangle& triangle : surface.triangles) {
    for (const SurfaceCorner& corner : triangle.corners) uv.emplace_back(corner.uv.x, rows.v(corner.uv.y));
  }
  return rasterize(uv, width, rows.count);
}

struct Owner {
  const SurfaceTriangle* triangle = nullptr;
  float b1 = 0, b2 = 0;
  std::size_t surface = 0;
};

/// Any unit vector across the normal, for frames without a tangent.
Vec3 any_across(const Vec3& normal) {
  const Vec3 axis = std::abs(normal.x) < 0.5F ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  return unit(axis - normal * axis.dot(normal));
}

LowPlace place_of(const Owner& owner) {
  const auto& [c0, c1, c2] = owner.triangle->corners;
  const float b1 = owner.b1, b2 = owner.b2, b0 = 1 - b1 - b2;
  Vec3 normal = c0.frame.normal * b0 + c1.frame.normal * b1 + c2.frame.normal * b2;
  normal = normal.length2() > 0 ? unit(normal) : owner.triangle->normal;
  Vec3 tangent = c0.frame.tangent * b0 + c1.frame.tangent * b1 + c2.frame.tangent * b2;
  tangent -= normal * tangent.dot(normal);
  tangent = tangent.length2() > 1e-12F ? unit(tangent) : any_across(normal);
  const float sign = c0.frame.sign;
  return {c0.position * b0 + c1.position * b1 + c2.position * b2,
          {tangent, normal.cross(tangent) * sign, normal, sign}};
}

}  // namespace

std::vector<LowTexel> LowTexels::band(int first_row, int rows) const {
  const int width = width_ * parts_;
  std::vector<Owner> owners(std::size_t(width) * rows * parts_);
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    const Surface& surface = surfaces_[s].surface;
    const UvRaster raster = raster_of(surface, width, {first_row * parts_, rows * parts_, height_ * parts_});
    for (std::size_t i = 0; i < owners.size(); ++i) {
      const TexelOwner& owner = raster.owners[i];
      if (owner.triangle < 0) continue;
      owners[i] = {&surface.triangles[std::size_t(owner.triangle)], owner.b1, owner.b2, s};
    }
  }
  std::vector<LowTexel> texels;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < width_; ++x) {
      LowTexel texel{x, first_row + y, 0, {}};
      for (int part = 0; part < parts_ * parts_; ++part) {
        const int column = x * parts_ + part % parts_, row = y * parts_ + part / parts_;
        const Owner& owner = owners[std::size_t(row) * width + column];
        if (owner.triangle == nullptr) continue;
        texel.surface = owner.surface;
        texel.places.push_back(place_of(owner));
      }
      if (!texel.places.empty()) texels.push_back(std::move(texel));
    }
  }
  return texels;
}

UvUse uv_use(std::span<const LowSurface> surfaces, int width, int height) {
  UvUse use;
  std::vector<std::int32_t> owner(std::size_t(width) * height, -1);
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> pairs;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const UvRaster raster = raster_of(surfaces[s].surface, width, {0, height, height});
    std::size_t covered = 0;
    for (std::size_t i = 0; i < owner.size(); ++i) {
      if (raster.owners[i].triangle < 0) continue;
      ++covered;
      if (raster.layers[i] > 1) ++pairs[{s, s}];
      if (owner[i] >= 0) ++pairs[{static_cast<std::size_t>(owner[i]), s}];
      owner[i] = static_cast<std::int32_t>(s);
    }
    use.texels.push_back(covered);
  }
  for (const auto& [pair, texels] : pairs) use.overlaps.push_back({pair.first, pair.second, texels});
  std::stable_sort(use.overlaps.begin(), use.overlaps.end(),
                   [](const UvOverlap& a, const UvOverlap& b) { return a.texels > b.texels; });
  return use;
}

}  // namespace rnmbake
