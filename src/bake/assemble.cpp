#include "bake/assemble.h"

#include "base/error.h"
#include "base/numeric/row_order.h"
#include "scene/uv_raster.h"

#include <algorithm>
#include <array>
#include <optional>

namespace rnmbake {
namespace {

/// A rectangle's picture addressed by texels of the whole lightmap, row 0 on top.
class Window {
 public:
  Window(const AtlasRect& rect, const FloatImage& picture, int map_height)
      : picture_(&picture), x0_(rect.x), y0_(other_row(rect.y + rect.size.height - 1, map_height)) {}

  [[nodiscard]] int x0() const { return x0_; }
  [[nodiscard]] int y0() const { return y0_; }
  [[nodiscard]] int x1() const { return x0_ + picture_->width(); }
  [[nodiscard]] int y1() const { return y0_ + picture_->height(); }

  /// RGB where the texel was baked.
  [[nodiscard]] std::optional<Vec3> at(int x, int y) const {
    if (x < x0() || y < y0() || x >= x1() || y >= y1()) return std::nullopt;
    const auto texel = picture_->texel(x - x0_, y - y0_);
    if (!(texel[3] > 0.5F)) return std::nullopt;
    return Vec3(texel[0], texel[1], texel[2]);
  }

 private:
  const FloatImage* picture_;
  int x0_, y0_;
};

template <typename Visit>
void for_each_covered(const Window& window, Visit visit) {
  for (int y = window.y0(); y < window.y1(); ++y) {
    for (int x = window.x0(); x < window.x1(); ++x) {
      if (const auto color = window.at(x, y)) visit(x, y, *color);
    }
  }
}

void store(FloatImage& image, int x, int y, const Vec3& color) {
  const auto texel = image.texel(x, y);
  for (int c = 0; c < 3; ++c) texel[std::size_t(c)] = color[c];
}

/// Triangle of each texel's centre, with barycentric weights.
class TexelGeometry {
 public:
  TexelGeometry(const Surface& surface, int width, int height) : surface_(surface) {
    std::vector<Vec2> uv;
    uv.reserve(3 * surface.triangles.size());
    for (const SurfaceTriangle& triangle : surface.triangles) {
      for (const SurfaceCorner& corner : triangle.corners) uv.push_back(corner.uv);
    }
    raster_ = rasterize(uv, width, height);
  }

  [[nodiscard]] const SurfaceTriangle* triangle(int x, int y) const {
    const std::int32_t index = raster_.at(x, y).triangle;
    return index < 0 ? nullptr : &surface_.triangles[std::size_t(index)];
  }

  /// Interpolates `value` of the corners at the texel's centre.
  template <typename Value>
  [[nodiscard]] Vec3 interpolate(int x, int y, Value value) const {
    const TexelOwner& owner = raster_.at(x, y);
    const auto& k = surface_.triangles[std::size_t(owner.triangle)].corners;
    return value(k[0]) * (1 - owner.b1 - owner.b2) + value(k[1]) * owner.b1 + value(k[2]) * owner.b2;
  }

 private:
  const Surface& surface_;
  UvRaster raster_;
};

/// E(b) of texels whose basis normal lies under their face: E(-b) + v.b, as bake/receiver.h explains.
class HorizonIdentity {
 public:
  HorizonIdentity(const TexelGeometry& geometry, const std::array<std::optional<Window>, 5>& moments)
      : geometry_(geometry), moments_(moments) {}

  /// Fills in the texels of `below`. `above`: rectangle of the same basis, baked with its legal normals.
  void apply(const Window& below, const std::optional<Window>& above, const Vec3& basis,
             FloatImage& radiance) const {
    for_each_covered(below, [&](int x, int y, const Vec3& reversed) {
      const SurfaceTriangle* face = geometry_.triangle(x, y);
      if (face == nullptr) return store(radiance, x, y, nearest_above(above, x, y, reversed));
      const Vec3 b =
          geometry_.interpolate(x, y, [&](const SurfaceCorner& c) { return basis_normal(c.frame, basis); })
              .normalized();
      const bool legal = b.dot(face->normal) >= 0;
      if (legal && above && above->at(x, y)) return;  // the cut runs through this texel, its centre is above
      const Vec3 value = reversed + moment(x, y, *face, b);
      store(radiance, x, y, Vec3(std::max(value.x, 0.0F), std::max(value.y, 0.0F), std::max(value.z, 0.0F)));
    });
  }

 private:
  /// v.b for each colour.
  [[nodiscard]] Vec3 moment(int x, int y, const SurfaceTriangle& face, const Vec3& b) const {
    const FaceAxes axes = face_axes(face.normal);
    const auto pass = [&](std::size_t m) {
      return moments_[m] ? moments_[m]->at(x, y).value_or(Vec3(0)) : Vec3(0);
    };
    return (pass(0) - pass(1)) * b.dot(axes.t1) + (pass(2) - pass(3)) * b.dot(axes.t2) +
           pass(4) * b.dot(face.normal);
  }

  static Vec3 nearest_above(const std::optional<Window>& above, int x, int y, const Vec3& otherwise) {
    return above ? above->at(x, y).value_or(otherwise) : otherwise;
  }

  const TexelGeometry& geometry_;
  std::array<std::optional<Window>, 5> moments_;
};

/// A texel whose centre lies on a cut may slip between the two parts: it takes the mean of the neighbours on
/// its side of the edge (faces that look the same way), or of all if there are none.
class CutFiller {
 public:
  CutFiller(const TexelGeometry& geometry, const FloatImage& coverage, const std::optional<Window>& above,
            const Window& below)
      : geometry_(geometry), coverage_(coverage), above_(above), below_(below) {}

  void fill(FloatImage& radiance) const {
    for (int y = 0; y < radiance.height(); ++y) {
      for (int x = 0; x < radiance.width(); ++x) {
        if (coverage_.texel(x, y)[0] > 0 && !baked(x, y)) store(radiance, x, y, around(x, y, radiance));
      }
    }
  }

 private:
  [[nodiscard]] bool baked(int x, int y) const {
    return (above_ && above_->at(x, y)) || below_.at(x, y).has_value();
  }

  [[nodiscard]] Vec3 around(int x0, int y0, const FloatImage& radiance) const {
    const SurfaceTriangle* face = geometry_.triangle(x0, y0);
    Vec3 same(0), any(0);
    float same_count = 0, any_count = 0;
    for (int y = std::max(y0 - 1, 0); y <= std::min(y0 + 1, radiance.height() - 1); ++y) {
      for (int x = std::max(x0 - 1, 0); x <= std::min(x0 + 1, radiance.width() - 1); ++x) {
        if (!baked(x, y)) continue;
        const auto texel = radiance.texel(x, y);
        const Vec3 color(texel[0], texel[1], texel[2]);
        const SurfaceTriangle* other = geometry_.triangle(x, y);
        any += color;
        ++any_count;
        if (face == nullptr || other == nullptr || face->normal.dot(other->normal) < 0.9999F) continue;
        same += color;
        ++same_count;
      }
    }
    return same_count > 0 ? same / same_count : any_count > 0 ? any / any_count : Vec3(0);
  }

  const TexelGeometry& geometry_;
  const FloatImage& coverage_;
  const std::optional<Window>& above_;
  const Window& below_;
};

void fill_frames(const TexelGeometry& geometry, TargetBakes& bakes) {
  const int width = bakes.coverage.width(), height = bakes.coverage.height();
  bakes.tangent = FloatImage(width, height, 4);
  bakes.normal = FloatImage(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const SurfaceTriangle* face = geometry.triangle(x, y);
      if (face == nullptr) continue;
      const auto tangent = [](const SurfaceCorner& c) { return c.frame.tangent; };
      const auto normal = [](const SurfaceCorner& c) { return c.frame.normal; };
      store(bakes.tangent, x, y, geometry.interpolate(x, y, tangent).normalized());
      bakes.tangent.texel(x, y)[3] = face->corners[0].frame.sign;
      store(bakes.normal, x, y, geometry.interpolate(x, y, normal).normalized());
    }
  }
}

bool any_covered(const FloatImage& coverage) {
  return std::any_of(coverage.data().begin(), coverage.data().end(), [](float c) { return c > 0; });
}

}  // namespace

void fill_frames(const Surface& surface, TargetBakes& bakes) {
  fill_frames(TexelGeometry(surface, bakes.coverage.width(), bakes.coverage.height()), bakes);
}

bool needs_surface(const std::vector<const AtlasRect*>& rects) {
  return std::any_of(rects.begin(), rects.end(),
                     [](const AtlasRect* rect) { return rect->pass.role != ReceiverPass::Role::basis; });
}

TargetBakes assemble(const Target& target, const std::vector<const AtlasRect*>& rects,
                     const std::vector<FloatImage>& pictures, const std::vector<BasisDirection>& bases,
                     const Surface* surface, bool frames) {
  const int width = target.width, height = target.height;
  TargetBakes result;
  result.coverage = FloatImage(width, height, 1);
  for (const BasisDirection& basis : bases)
    result.bases.push_back({basis.name, basis.direction, FloatImage(width, height, 3)});

  std::vector<std::optional<Window>> above(bases.size());
  std::vector<std::optional<Window>> below(bases.size());
  std::array<std::optional<Window>, 5> moments;
  for (std::size_t i = 0; i < rects.size(); ++i) {
    const Window window(*rects[i], pictures[i], height);
    const ReceiverPass& pass = rects[i]->pass;
    if (pass.role == ReceiverPass::Role::moment) {
      moments[pass.basis] = window;
      continue;
    }
    (pass.role == ReceiverPass::Role::basis ? above : below)[pass.basis] = window;
    for_each_covered(window, [&](int x, int y, const Vec3& color) {
      result.coverage.texel(x, y)[0] = 1;
      if (pass.role == ReceiverPass::Role::basis) store(result.bases[pass.basis].radiance, x, y, color);
    });
  }

  std::optional<TexelGeometry> geometry;
  if (surface != nullptr) geometry.emplace(*surface, width, height);
  if (geometry) {
    const HorizonIdentity identity(*geometry, moments);
    for (std::size_t b = 0; b < bases.size(); ++b) {
      if (!below[b]) continue;
      FloatImage& radiance = result.bases[b].radiance;
      identity.apply(*below[b], above[b], in_frame(bases[b].direction, target), radiance);
      CutFiller(*geometry, result.coverage, above[b], *below[b]).fill(radiance);
    }
  }
  if (geometry && frames) fill_frames(*geometry, result);
  if (!any_covered(result.coverage)) {
    fail(ExitCode::tasks_failed,
         "Blender baked no texel of '{}': are its faces smaller than a texel? Raise --resolution or "
         "--texels-per-unit",
         target.key);
  }
  return result;
}

}  // namespace rnmbake
