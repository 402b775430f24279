#include "scene/uv_raster.h"

#include "base/numeric/row_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rnmbake {
namespace {

/// Blender moves the sample points by this much of a texel, so that edges on texel centres, which aligned UVs
/// make common, belong to one triangle. The numbers decide ties: they must be Blender's.
constexpr float nudge_x = 0.001F, nudge_y = 0.002F;

using Corners = std::array<Vec2, 3>;

/// Texel coordinates, y up, with the sample points on whole numbers. Single precision, as Blender has it.
Vec2 to_samples(const Vec2& uv, int width, int height) {
  return {uv.x * static_cast<float>(width) - (0.5F + nudge_x),
          uv.y * static_cast<float>(height) - (0.5F + nudge_y)};
}

/// The whole numbers of [low, high] that are rows or columns of the picture.
struct Range {
  int first, last;
};

Range clip(double low, double high, int count) {
  return {static_cast<int>(std::clamp(low, 0.0, static_cast<double>(count))),
          static_cast<int>(std::clamp(high, -1.0, count - 1.0))};
}

/// Where the line y cuts the triangle: open on the left, closed on the right.
Range span_of_row(const Corners& c, double y, int width) {
  double left = std::numeric_limits<double>::infinity(), right = -left;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 &a = c[i], &b = c[(i + 1) % 3];
    const Vec2 &low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
    if (low.y == high.y || y < low.y || y > high.y) {
      continue;
    }
    const double t = (y - low.y) / (static_cast<double>(high.y) - low.y);
    const double x = low.x + t * (static_cast<double>(high.x) - low.x);
    left = std::min(left, x);
    right = std::max(right, x);
  }
  return clip(std::floor(left) + 1, std::floor(right), width);
}

/// Barycentric weights are affine in the texel: b = origin + x dx + y dy.
struct Weights {
  double b1, b2, b1_dx, b2_dx, b1_dy, b2_dy;

  Weights(const Corners& c, double area) {
    const double x1 = double{c[1].x} - c[0].x, y1 = double{c[1].y} - c[0].y;
    const double x2 = double{c[2].x} - c[0].x, y2 = double{c[2].y} - c[0].y;
    b1_dx = y2 / area;
    b1_dy = -x2 / area;
    b2_dx = -y1 / area;
    b2_dy = x1 / area;
    // Texel centres lie the nudge below and left of the sample points.
    b1 = -(double{c[0].x} + nudge_x) * b1_dx - (double{c[0].y} + nudge_y) * b1_dy;
    b2 = -(double{c[0].x} + nudge_x) * b2_dx - (double{c[0].y} + nudge_y) * b2_dy;
  }

  [[nodiscard]] TexelOwner at(std::int32_t triangle, int x, int y) const {
    const double w1 = std::clamp(b1 + x * b1_dx + y * b1_dy, 0.0, 1.0);
    const double w2 = std::clamp(b2 + x * b2_dx + y * b2_dy, 0.0, 1.0 - w1);
    return {triangle, static_cast<float>(w1), static_cast<float>(w2)};
  }
};

void draw(const Corners& c, std::int32_t triangle, UvRaster& raster) {
  const double area = (double{c[1].x} - c[0].x) * (double{c[2].y} - c[0].y) -
                      (double{c[1].y} - c[0].y) * (double{c[2].x} - c[0].x);
  if (area == 0) {
    return;
  }
  const Weights weights(c, area);
  const auto [low, high] = std::minmax({c[0].y, c[1].y, c[2].y});
  const Range rows = clip(std::ceil(low), std::floor(high), raster.height);
  for (int y = rows.first; y <= rows.last; ++y) {
    const Range columns = span_of_row(c, y, raster.width);
    const std::size_t row = std::size_t(other_row(y, raster.height)) * raster.width;
    for (int x = columns.first; x <= columns.last; ++x) {
      raster.owners[row + x] = weights.at(triangle, x, y);
      std::uint16_t& layers = raster.layers[row + x];
      layers = static_cast<std::uint16_t>(std::min(layers + 1, 0xffff));
    }
  }
}

}  // namespace

UvRaster rasterize(const std::vector<Vec2>& corner_uv, int width, int height) {
  UvRaster raster{width, height, {}, {}};
  raster.owners.resize(std::size_t(width) * height);
  raster.layers.resize(std::size_t(width) * height);
  for (std::size_t i = 0; i + 2 < corner_uv.size(); i += 3) {
    const Corners corners{to_samples(corner_uv[i], width, height),
                          to_samples(corner_uv[i + 1], width, height),
                          to_samples(corner_uv[i + 2], width, height)};
    draw(corners, static_cast<std::int32_t>(i / 3), raster);
  }
  return raster;
}

}  // namespace rnmbake
