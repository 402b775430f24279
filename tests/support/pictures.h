// tests/support/pictures.h - pictures of one colour, and figures of pictures.
#pragma once

#include "image/float_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace rnmbake {

inline FloatImage filled(int width, int height, int channels, float value) {
  FloatImage image(width, height, channels);
  std::ranges::fill(image.data(), value);
  return image;
}

/// Root of the mean square of the differences, over all values of two pictures of one form.
inline double rms_difference(const FloatImage& a, const FloatImage& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.data().size(); ++i) sum += std::pow(double(a.data()[i]) - b.data()[i], 2);
  return std::sqrt(sum / double(a.data().size()));
}

/// Infinite where the two have not one form.
inline double largest_difference(const FloatImage& a, const FloatImage& b) {
  if (a.width() != b.width() || a.data().size() != b.data().size())
    return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t i = 0; i < a.data().size(); ++i)
    largest = std::max(largest, std::abs(double(a.data()[i]) - b.data()[i]));
  return largest;
}

/// Means of red, green and blue over the covered texels, and their standard errors from the texels' scatter.
struct ColourMeans {
  std::array<double, 3> value{}, error{};
};

inline ColourMeans covered_means(const FloatImage& colours, const FloatImage& coverage) {
  ColourMeans means;
  std::array<double, 3> squares{};
  double texels = 0;
  for (std::size_t i = 0; i < coverage.texels(); ++i) {
    if (coverage.data()[i] < 0.5F) continue;
    ++texels;
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = colours.data()[3 * i + c];
      means.value[c] += value;
      squares[c] += value * value;
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    means.value[c] /= texels;
    const double variance = squares[c] / texels - means.value[c] * means.value[c];
    means.error[c] = std::sqrt(std::max(variance, 0.0) / texels);
  }
  return means;
}

}  // namespace rnmbake
