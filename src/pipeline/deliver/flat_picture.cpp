#include "pipeline/deliver/flat_picture.h"

#include "image/display_png.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rnmbake {

float white_of(const std::vector<const FloatImage*>& flat, const std::vector<const FloatImage*>& coverage) {
  std::vector<float> values;
  for (std::size_t page = 0; page < flat.size(); ++page) {
    for (std::size_t i = 0; i < flat[page]->texels(); ++i) {
      if (coverage[page]->data()[i] <= 0.5F) continue;
      for (std::size_t c = 0; c < 3; ++c) values.push_back(flat[page]->data()[3 * i + c]);
    }
  }
  if (values.empty()) return 1;
  const std::size_t passed = values.size() / 1000;
  std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(passed), std::ranges::greater());
  const float most = *std::max_element(values.begin(), values.begin() + std::ptrdiff_t(passed) + 1);
  const float nearly_most = values[passed];
  return std::max(most <= 2 * nearly_most ? most : nearly_most, 1e-6F);
}

PictureMetrics write_flat_picture(const std::filesystem::path& file, const FloatImage& flat,
                                  const FloatImage& coverage, float white) {
  write_display_png(file, flat, -std::log2(white));
  FloatImage seen = read_image(file).layers.front().pixels;
  for (float& value : seen.data()) value = white * srgb_decode(value);
  PictureComparison comparison;
  comparison.add({&seen}, {&flat}, {{&coverage}});
  return comparison.metrics();
}

}  // namespace rnmbake
