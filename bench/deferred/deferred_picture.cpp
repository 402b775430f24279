#include "deferred_picture.h"

#include "image/display_png.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace rnmbake {
namespace {

constexpr int left_edge = 95, top_edge = 75, wide = 400, high = 270;  // what is shown of the view
constexpr int columns = 3, gap = 4;
constexpr float sky = 0.1F, sun = 0.9F;

/// Few greys, so that the file stays small.
float stepped(float value) {
  return std::round(value * 40) / 40;
}

}  // namespace

void write_panels(const std::filesystem::path& file, const LitPixels& lit,
                  const std::vector<FloatImage>& left) {
  const int rows = (static_cast<int>(left.size()) + columns - 1) / columns;
  FloatImage picture(columns * (wide + gap) - gap, rows * (high + gap) - gap, 3);
  for (float& value : picture.data()) value = 1;
  for (std::size_t panel = 0; panel < left.size(); ++panel) {
    const int x0 = static_cast<int>(panel) % columns * (wide + gap),
              y0 = static_cast<int>(panel) / columns * (high + gap);
    for (int y = 0; y < high; ++y) {
      for (int x = 0; x < wide; ++x) {
        const auto at = [&](const FloatImage& image) { return image.texel(left_edge + x, top_edge + y)[0]; };
        const float light = at(lit.cosine) * at(lit.seen);
        const float grey = srgb_decode(stepped(srgb_encode(sky + sun * light * at(left[panel]))));
        const bool falsely = light > 0 && at(lit.truth) > 0.5F && at(left[panel]) <= 0.5F;
        const std::array<float, 3> colour{falsely ? 0.7F : grey, falsely ? 0.08F : grey,
                                          falsely ? 0.05F : grey};
        std::ranges::copy(colour, picture.texel(x0 + x, y0 + y).begin());
      }
    }
  }
  write_display_png(file, picture, 0);
}

}  // namespace rnmbake
