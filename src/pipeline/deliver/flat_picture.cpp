#include "pipeline/deliver/flat_picture.h"

#include "image/display_png.h"
#include "image/layered_exr.h"
#include "lightmap/fill.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rnmbake {

float white_of(const std::vector<Page>& pages) {
  std::vector<float> values;
  for (const Page& page : pages) {
    const std::vector<float>& flat = page.layers.front().pixels.data();
    const TexelMask covered = covered_mask(page.coverage);
    for (std::size_t i = 0; i < covered.size(); ++i) {
      for (std::size_t c = 0; c < 3 && covered[i] != 0; ++c) values.push_back(flat[3 * i + c]);
    }
  }
  if (values.empty()) return 1;
  const std::size_t passed = values.size() / 1000;
  std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(passed), std::ranges::greater());
  const float most = *std::max_element(values.begin(), values.begin() + std::ptrdiff_t(passed) + 1);
  const float nearly_most = values[passed];
  return std::max(most <= 2 * nearly_most ? most : nearly_most, 1e-6F);
}

PictureMetrics write_flat_picture(const std::filesystem::path& file, const Page& page, float white) {
  const FloatImage& flat = page.layers.front().pixels;
  write_display_png(file, flat, -std::log2(white));
  FloatImage seen = read_image(file).layers.front().pixels;
  for (float& value : seen.data()) value = white * srgb_decode(value);
  PictureComparison comparison;
  comparison.add({&seen}, {&flat}, {{&page.coverage}});
  return comparison.metrics();
}

}  // namespace rnmbake
