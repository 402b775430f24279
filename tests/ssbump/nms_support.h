// ssbump/nms_support.h - surfaces and lights for the tests of normal mapping shadows.
#pragma once

#include "base/math.h"
#include "ssbump/heights/height_field.h"
#include "ssbump/map/normals.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rnmbake {

/// Heights from a function of column and row.
template <typename Height>
HeightField field_of(int width, int height, Height height_at) {
  HeightField field{FloatImage(width, height, 1)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) field.heights.texel(x, y)[0] = static_cast<float>(height_at(x, y));
  return field;
}

inline FloatImage normals_of_field(const HeightField& field) {
  return height_normals(field, 0, field.height());
}

/// The same normal everywhere.
inline FloatImage even_normals(int width, int height, const Vec3& normal) {
  FloatImage normals(width, height, 3);
  const Vec3 n = unit(normal);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) std::ranges::copy(std::array{n.x, n.y, n.z}, normals.texel(x, y).begin());
  return normals;
}

/// Tiles without a seam; at `steepness` 1 no light above 50 degrees has a shadow, at 4 it has.
inline HeightField waves(int width, int height, double steepness = 1) {
  return field_of(width, height, [&](int x, int y) {
    const double u = 2 * pi * x / width, v = 2 * pi * y / height;
    return steepness * width / 16.0 *
           (std::sin(2 * u + 0.3) + std::sin(u + 2 * v) + 0.5 * std::cos(3 * v - u));
  });
}

/// Towards a light; degrees, the azimuth counted from +x to +y.
inline Vec3 light_from(double azimuth, double elevation) {
  const double a = azimuth * pi / 180, e = elevation * pi / 180;
  return Vec3(Vec3d(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e)));
}

}  // namespace rnmbake
