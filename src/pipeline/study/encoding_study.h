// pipeline/study/encoding_study.h - how far each encoding is from the light that it was made from, by the
// tilt of the normal.
#pragma once

#include "encoding/codec.h"

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Degrees between a normal and the surface's own: errors are means over all tested normals up to each.
inline constexpr std::array<double, 4> tilt_limits{25, 45, 60, 90};

struct EncodingErrors {
  std::string label;  // "zh3", "zh3 K=2 8 bits"
  CodecOptions codec;
  std::size_t bakes = 0;  // directions that it is made from
  int bytes = 0;          // of a texel as engines store it: half floats, or packed
  std::array<double, tilt_limits.size()> rms{}, bias{};  // shares of the flat light; bias: decoded minus true
  double flat_bias = 0;                                  // of the flat normal
  std::string unfit;  // why the directions cannot feed it; the rest is then 0
};

/// Sums over lights. Errors are relative to the flat light by energy:
/// rms^2 = sum of (decoded - true)^2 / sum of flat^2, over lights, colours and normals; so that black texels
/// count for nothing and need no limit.
class EncodingStudy {
 public:
  /// `fed`: directions with known irradiance, flat among them; each codec is made from the smallest set of
  /// encoding/direction_sets.h among them that feeds it. `normals`: unit, tangent space, where they are
  /// tested.
  EncodingStudy(const BasisSet& fed, const std::vector<Vec3>& normals);

  /// Of the same codecs and normals, without a light yet: for another thread.
  [[nodiscard]] EncodingStudy another() const;

  /// One light: E/pi, RGB, at each direction of `fed` and at each of the normals.
  void add(std::span<const Vec3> at_fed, std::span<const Vec3> at_normals);

  /// Adds the lights of another() one.
  void merge(const EncodingStudy& other);

  [[nodiscard]] std::size_t lights() const { return lights_; }

  /// What an encoding, by its place in encodings_to_study(), decodes of one light, given as for add(), at a
  /// unit normal of tangent space; 0 where it is unfit.
  [[nodiscard]] Vec3 decoded(std::size_t encoding, std::span<const Vec3> at_fed, const Vec3& normal) const;

  /// In the order of encodings_to_study().
  [[nodiscard]] std::vector<EncodingErrors> errors() const;

 private:
  struct Setup;
  struct Sums {
    std::array<double, tilt_limits.size()> squares{}, errors{};  // of the normals whose band it is
    double flat_error = 0;
  };

  void add_codec(std::size_t codec, std::span<const Vec3> at_fed, std::span<const Vec3> at_normals);

  std::shared_ptr<const Setup> setup_;
  std::vector<Sums> sums_;  // [codecs]
  double flat_squares_ = 0, flat_sum_ = 0;
  std::size_t lights_ = 0;
};

/// Every encoding, the packed forms beside the plain ones.
[[nodiscard]] std::vector<CodecOptions> encodings_to_study();

/// As a text table, as Markdown, or as JSON.
[[nodiscard]] std::string study_table(const std::vector<EncodingErrors>& errors);
[[nodiscard]] std::string study_markdown(const std::vector<EncodingErrors>& errors);
[[nodiscard]] nlohmann::json study_json(const std::vector<EncodingErrors>& errors, std::size_t lights);

}  // namespace rnmbake
