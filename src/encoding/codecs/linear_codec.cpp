#include "encoding/codecs/linear_codec.h"

#include "base/error.h"
#include "encoding/encodings.h"
#include "encoding/fit/least_squares.h"
#include "encoding/hbasis.h"
#include "encoding/rnm.h"
#include "encoding/sg.h"
#include "encoding/sh.h"
#include "encoding/sh_rotation.h"

#include <algorithm>
#include <array>

namespace rnmbake {
namespace {

struct Functions {
  std::string_view encoding;
  std::span<const std::string_view> layers;
  void (*values)(const Vec3d& normal, std::span<double> values);
  void (*rotate)(std::span<Vec3> layers, const TexelFrame& frame);  // null: bound to tangent space
  std::string_view set;                                             // of direction_set(), that feeds it
};

void sh2_values(const Vec3d& n, std::span<double> values) {
  std::ranges::copy(std::array{1.0, n.x, n.y, n.z}, values.begin());
}

void sh3_values(const Vec3d& n, std::span<double> values) {
  std::ranges::copy(sh_irradiance_basis(Vec3(n)), values.begin());
}

void h_values(const Vec3d& n, std::span<double> values) {
  std::ranges::copy_n(h_basis(n).begin(), static_cast<std::ptrdiff_t>(values.size()), values.begin());
}

void sg_values(const Vec3d& n, std::span<double> values) {
  std::ranges::copy(sg_basis(n), values.begin());
}

void rotate_sh2(std::span<Vec3> layers, const TexelFrame& frame) {
  for (int c = 0; c < 3; ++c) {
    const Vec3 v = frame.stored(Vec3(layers[1][c], layers[2][c], layers[3][c]));
    for (int axis = 0; axis < 3; ++axis) layers[1 + static_cast<std::size_t>(axis)][c] = v[axis];
  }
}

const std::array<Functions, 5>& all_functions() {
  static const std::array<Functions, 5> all{{{"sh2", l1_layers, sh2_values, rotate_sh2, "l1"},
                                             {"sh3", sh_layers, sh3_values, rotate_sh3, "sh3"},
                                             {"h4", h4_layers, h_values, nullptr, "l1"},
                                             {"h6", h6_layers, h_values, nullptr, "h6"},
                                             {"sg", sg_layers, sg_values, nullptr, "sg"}}};
  return all;
}

const Functions& functions_of(const std::string& encoding) {
  return *std::ranges::find(all_functions(), encoding, &Functions::encoding);
}

LeastSquares fit_of(const Functions& functions, const std::string& encoding, const BasisSet& set) {
  std::vector<std::vector<double>> values;
  for (const BasisDirection& basis : set.directions) {
    values.emplace_back(functions.layers.size());
    functions.values(Vec3d(basis.direction), values.back());
  }
  return {values, needed_direction(set, flat_direction(), encoding)};
}

LeastSquares sound_fit_of(const Functions& functions, const std::string& encoding, const BasisSet& set) {
  LeastSquares fit = fit_of(functions, encoding, set);
  if (!(fit.condition() <= greatest_condition)) {
    fail(ExitCode::unsupported,
         "the {} directions of '{}' do not determine the encoding '{}' (condition {:.3g}, at most {}); bake "
         "--basis-set {}",
         set.directions.size(), set.name, encoding, fit.condition(), greatest_condition, functions.set);
  }
  return fit;
}

class LinearCodec : public TexelCodec {
 public:
  LinearCodec(const Functions& functions, LeastSquares fit)
      : functions_(functions),
        fit_(std::move(fit)),
        layers_(functions.layers.begin(), functions.layers.end()) {}

  const std::vector<std::string>& layers() const override { return layers_; }
  bool can_rotate() const override { return functions_.rotate != nullptr; }

  Vec3 decode(std::span<const Vec3> layers, const Vec3& normal) const override {
    std::array<double, 9> values{};
    const std::span used(values.data(), layers_.size());
    functions_.values(Vec3d(normal), used);
    Vec3d light(0);
    for (std::size_t i = 0; i < used.size(); ++i) light += Vec3d(layers[i]) * used[i];
    return Vec3(light);
  }

 private:
  EncodeCounts encode_texel(std::span<const Vec3> irradiance, std::span<Vec3> layers,
                            const TexelFrame& frame) const override {
    fit_.solve(irradiance, layers);
    if (functions_.rotate != nullptr) functions_.rotate(layers, frame);
    return {};
  }

  const Functions& functions_;
  LeastSquares fit_;
  std::vector<std::string> layers_;
};

class SignedCodec : public TexelCodec {
 public:
  SignedCodec(LeastSquares sh3, std::size_t flat) : sh3_(std::move(sh3)), flat_(flat) {}

  const std::vector<std::string>& layers() const override { return layers_; }
  bool can_rotate() const override { return false; }
  Vec3 decode(std::span<const Vec3> layers, const Vec3& normal) const override {
    return rnm_decode_linear(std::array{layers[0], layers[1], layers[2]}, normal);
  }

 private:
  EncodeCounts encode_texel(std::span<const Vec3> irradiance, std::span<Vec3> layers,
                            const TexelFrame&) const override {
    std::array<Vec3, 9> sh;
    sh3_.solve(irradiance, sh);
    const float twice = 2 * sh_cosine_over_pi[1] * 0.48860251F;  // of (1, -1) ~ y and (1, 1) ~ x
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 b = rnm_basis()[i];
      layers[i] = sh[3] * (twice * b.x) + sh[1] * (twice * b.y) + irradiance[flat_] * b.z;
    }
    return {};
  }

  LeastSquares sh3_;
  std::size_t flat_;
  std::vector<std::string> layers_{rnm_layers.begin(), rnm_layers.end()};
};

}  // namespace

std::unique_ptr<const Codec> linear_codec(const CodecOptions& options, const BasisSet& directions) {
  const Functions& functions = functions_of(options.name);
  return std::make_unique<LinearCodec>(functions, sound_fit_of(functions, options.name, directions));
}

std::unique_ptr<const Codec> signed_codec(const CodecOptions& options, const BasisSet& directions) {
  return std::make_unique<SignedCodec>(sound_fit_of(functions_of("sh3"), options.name, directions),
                                       needed_direction(directions, flat_direction(), options.name));
}

double condition_of(const std::string& encoding, const BasisSet& directions) {
  return fit_of(functions_of(encoding), encoding, directions).condition();
}

}  // namespace rnmbake
