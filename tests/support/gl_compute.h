// support/gl_compute.h - GLSL functions, executed: a compute shader on Mesa's software renderer, without a
// window.
#pragma once

#include "base/math.h"
#include "image/float_image.h"
#include "image/sample.h"

#include <span>
#include <string>
#include <vector>

namespace rnmbake {

class GlCompute {
 public:
  /// Throws std::runtime_error with the remedy where there is no EGL or no software renderer.
  GlCompute();
  ~GlCompute();
  GlCompute(const GlCompute&) = delete;
  GlCompute& operator=(const GlCompute&) = delete;

  /// What `body` returns for each case. source: GLSL functions. body: statements that end with
  /// `return vec3(...);`; at(k) is the k-th of the case's `width` vectors. inputs: those of all cases, one
  /// case after the other. Throws std::runtime_error with the compiler's words.
  [[nodiscard]] std::vector<Vec3> run(const std::string& source, const std::string& body, std::size_t width,
                                      std::span<const Vec3> inputs);

  /// A three-channel picture as the sampler2D of this name, for the runs to come, in place of an earlier one:
  /// 32-bit floats, bilinear; its row 0 is at v = 0.
  void add_texture(const std::string& name, const FloatImage& image, Border border = Border::wrap);

 private:
  struct Texture {
    std::string name;
    unsigned id;
  };
  void* display_ = nullptr;
  void* context_ = nullptr;
  std::vector<Texture> textures_;
};

}  // namespace rnmbake
