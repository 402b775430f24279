#include "trace/lights/emissive_triangle.h"

#include "base/math.h"
#include "trace/geometry/surface_materials.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace rnmbake {
namespace {

/// Summed-area tables of a picture: brightness, and number of lit texels.
class PictureSums {
 public:
  explicit PictureSums(const Texture& picture) : picture_(picture), width_(picture.width + 1) {
    const std::size_t size = std::size_t(width_) * (picture.height + 1);
    light_.resize(size);
    lit_.resize(size);
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const float value = mean_magnitude(picture.texels[std::size_t(y) * picture.width + x]);
        const std::size_t at = std::size_t(y + 1) * width_ + x + 1;
        light_[at] = double(value) + light_[at - 1] + light_[at - width_] - light_[at - width_ - 1];
        lit_[at] = (value > 0) + lit_[at - 1] + lit_[at - width_] - lit_[at - width_ - 1];
      }
    }
  }

  /// Mean brightness of the texels that lookups in the rectangle filter; > 0 where one of them is.
  [[nodiscard]] float mean(const Vec2& low, const Vec2& high) const {
    const int x0 = first(low.x, picture_.width), x1 = last(high.x, picture_.width);
    const int y0 = first(1 - high.y, picture_.height), y1 = last(1 - low.y, picture_.height);
    const auto sum = [&](const auto& table) {
      const auto at = [&](int x, int y) { return table[std::size_t(y) * width_ + x]; };
      return at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0);
    };
    const std::uint32_t lit = sum(lit_);
    if (lit == 0) return 0;
    const double texels = double(x1 - x0) * (y1 - y0);
    return static_cast<float>(std::max(sum(light_) / texels, 1e-12));
  }

 private:
  static int first(float v, int count) {
    return static_cast<int>(
        std::clamp(std::floor(v * static_cast<float>(count) - 0.51F), 0.0F, static_cast<float>(count - 1)));
  }
  static int last(float v, int count) {
    return static_cast<int>(
        std::clamp(std::floor(v * static_cast<float>(count) + 0.51F) + 1, 1.0F, static_cast<float>(count)));
  }

  const Texture& picture_;
  std::size_t width_;
  std::vector<double> light_;
  std::vector<std::uint32_t> lit_;
};

class BrightnessEstimator {
 public:
  explicit BrightnessEstimator(const DiffuseScene& scene)
      : scene_(scene), materials_(scene), sums_(scene.pictures.size()) {}

  [[nodiscard]] float of(std::uint32_t material, const Vec2* uv) {
    const int picture = scene_.materials[material].emission_picture;
    if (picture < 0) return mean_magnitude(scene_.materials[material].emission);
    if (!sums_[picture]) sums_[picture] = std::make_unique<PictureSums>(scene_.pictures[picture]);
    Vec2 low = uv[0], high = uv[0];
    for (int k = 1; k < 3; ++k) {
      low = Vec2(std::min(low.x, uv[k].x), std::min(low.y, uv[k].y));
      high = Vec2(std::max(high.x, uv[k].x), std::max(high.y, uv[k].y));
    }
    const float around = sums_[picture]->mean(low, high);
    return around > 0 ? (around + 3 * inside(material, uv)) / 4 : 0.0F;
  }

 private:
  /// Mean over a few points of the triangle: its bounding rectangle of texels covers neighbours, too.
  [[nodiscard]] float inside(std::uint32_t material, const Vec2* uv) const {
    constexpr int steps = 4;
    float sum = 0;
    for (int i = 0; i < steps; ++i) {
      for (int j = 0; i + j < steps; ++j) {
        const float b1 = (static_cast<float>(i) + 1.0F / 3) / steps;
        const float b2 = (static_cast<float>(j) + 1.0F / 3) / steps;
        sum += mean_magnitude(materials_.emission(material, uv[0] * (1 - b1 - b2) + uv[1] * b1 + uv[2] * b2));
      }
    }
    constexpr int points = steps * (steps + 1) / 2;
    return sum / points;
  }

  const DiffuseScene& scene_;
  SurfaceMaterials materials_;
  std::vector<std::unique_ptr<PictureSums>> sums_;  // [pictures], made when first asked for
};

}  // namespace

std::vector<EmissiveTriangle> find_emissive_triangles(const DiffuseScene& scene, const Triangles& triangles) {
  BrightnessEstimator brightness(scene);
  const SurfaceMaterials materials(scene);
  std::vector<EmissiveTriangle> found;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!materials.emits(triangles.material[t])) continue;
    EmissiveTriangle emitter;
    emitter.brightness = brightness.of(triangles.material[t], &triangles.uv[3 * t]);
    if (!(emitter.brightness > 0)) continue;
    const Vec3* p = &triangles.position[3 * t];
    emitter.shape = light_triangle(p[0], p[1], p[2]);
    emitter.triangle = static_cast<std::uint32_t>(t);
    if (emitter.shape.area > 0) found.push_back(emitter);
  }
  return found;
}

}  // namespace rnmbake
