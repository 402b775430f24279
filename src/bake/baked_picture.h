// bake/baked_picture.h - one rectangle's picture as the mean of passes, half by half.
#pragma once

#include "bake/sample_passes.h"
#include "image/float_image.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

/// RGBA, E/pi, row 0 on top, alpha = coverage. A half without samples has no picture.
struct BakedPicture {
  std::array<FloatImage, 2> halves;
  HalfSamples samples{0, 0};

  /// Takes in `count` samples of a half, whose mean is `pass`. The result depends on the order of passes by
  /// rounding alone.
  void add(int half, FloatImage pass, int count);

  [[nodiscard]] int all_samples() const { return samples[0] + samples[1]; }

  /// Over both halves.
  [[nodiscard]] FloatImage mean() const;

  /// Whether both halves are there, so that the error can be known.
  [[nodiscard]] bool has_error() const { return samples[0] > 0 && samples[1] > 0; }

  /// Factor from the squared difference of the halves to the variance of their mean.
  [[nodiscard]] double variance_factor() const;
};

/// Root mean square of the standard errors of a picture's covered values, and their mean. No error is known
/// with one half alone.
struct NoiseSums {
  double squares = 0, values = 0;
  std::size_t count = 0;
  void add(const BakedPicture& picture);
  /// A share of the mean; 0 where nothing is covered, or all is black.
  [[nodiscard]] double relative() const;
};

/// Pictures as bytes and back: covered texels alone. Nothing where they are no such bytes.
[[nodiscard]] std::string to_bytes(std::span<const BakedPicture> pictures);
[[nodiscard]] std::optional<std::vector<BakedPicture>> from_bytes(std::string_view bytes);

}  // namespace rnmbake
