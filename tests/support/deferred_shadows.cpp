#include "support/deferred_shadows.h"

#include "shaders/engines.h"

#include <cstddef>
#include <utility>
#include <vector>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

constexpr float far_away = 1e9F;  // no range reaches it, and a mean with it neither

/// Textures have three channels.
FloatImage as_texture(const FloatImage& image) {
  FloatImage texture(image.width(), image.height(), 3);
  for (std::size_t i = 0; i < image.texels(); ++i) texture.data()[3 * i] = image.data()[i];
  return texture;
}

FloatImage packed(FloatImage normals) {
  for (float& value : normals.data()) value = 0.5F + 0.5F * value;
  return normals;
}

}  // namespace

FloatImage stencilled(FloatImage depths, const FloatImage& taken, float number) {
  for (std::size_t i = 0; i < depths.texels(); ++i)
    if (taken.data()[i] != number) depths.data()[i] = far_away;
  return depths;
}

FloatImage deferred_shadows(GlCompute& compute, const DeferredInput& input, const Vec3& light) {
  const int width = input.normals.width(), height = input.normals.height();
  std::vector<Vec3> pixels;
  pixels.reserve(input.normals.texels());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      pixels.emplace_back((static_cast<float>(x) + 0.5F) / static_cast<float>(width),
                          (static_cast<float>(y) + 0.5F) / static_cast<float>(height),
                          input.depths.texel(x, y)[0]);
  compute.add_texture("normal_texture", packed(input.normals), Border::clamp);
  compute.add_texture("depth_texture", as_texture(input.tested), Border::clamp);
  const std::string body = fmt::format(
      "if (at(0).z <= 0.0) return vec3(1.0);\n"
      "vec2 walk = vec2({:.9f}, {:.9f}) / at(0).z;\n"
      "return vec3(normal_shadow_deferred(normal_texture, depth_texture, at(0).xy, vec3({:.9f}, {:.9f}, "
      "{:.9f}), walk, {:.9f}, {}, {:.9f}, 0.0), 0.0, 0.0);",
      input.walk.x, input.walk.y, light.x, light.y, light.z, input.range, input.steps, input.hardness);
  const std::vector<Vec3> left =
      compute.run(shader_text(engine_named("glsl"), {"normal_shadows_deferred"}), body, 1, pixels);
  FloatImage result(width, height, 1);
  for (std::size_t i = 0; i < left.size(); ++i) result.data()[i] = left[i].x;
  return result;
}

}  // namespace rnmbake
