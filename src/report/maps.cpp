#include "report/maps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rnmbake {
namespace {

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
constexpr int smallest = 16, largest = 256;
constexpr std::size_t most_texels = 1U << 22;  // of all maps of a report: about 30 MB of page

struct Mean {
  double sum = 0;
  int values = 0;

  void add(float value) {
    if (!std::isfinite(value)) return;
    sum += value;
    ++values;
  }
  [[nodiscard]] float get() const { return values == 0 ? nothing : static_cast<float>(sum / values); }
};

FloatImage values_of(const ComparedPicture& picture, const std::vector<CountedWhere>& counted) {
  FloatImage out = *picture.value;
  const auto channels = static_cast<std::size_t>(out.channels());
  for (std::size_t i = 0; i < out.data().size(); ++i) {
    out.data()[i] =
        counts(counted, i / channels) ? static_cast<float>(noisy_value(picture, i).value) : nothing;
  }
  return out;
}

/// RMS over the channels. Where there are two halves this is the standard error's estimate from two values:
/// rough for one texel, right in the mean of many.
FloatImage noise_of(const ComparedPicture& picture, const std::vector<CountedWhere>& counted) {
  if (!picture.knows_noise()) return {};
  const FloatImage& value = *picture.value;
  const auto channels = static_cast<std::size_t>(value.channels());
  FloatImage out(value.width(), value.height(), 1);
  for (std::size_t texel = 0; texel < out.texels(); ++texel) {
    double variance = 0;
    for (std::size_t c = 0; c < channels; ++c)
      variance += noisy_value(picture, texel * channels + c).variance;
    out.data()[texel] =
        counts(counted, texel) ? static_cast<float>(std::sqrt(variance / double(channels))) : nothing;
  }
  return out;
}

}  // namespace

int map_limit(std::size_t objects, std::size_t bases) {
  int limit = largest;
  const std::size_t maps = std::max<std::size_t>(objects, 1) * std::max<std::size_t>(bases, 1);
  while (limit > smallest && maps * limit * limit > most_texels) limit /= 2;
  return limit;
}

FloatImage shrink(const FloatImage& image, int limit) {
  const int longest = std::max(image.width(), image.height());
  const int factor = (longest + limit - 1) / std::max(limit, 1);
  if (factor < 2) return image;
  FloatImage out((image.width() + factor - 1) / factor, (image.height() + factor - 1) / factor,
                 image.channels());
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      for (int c = 0; c < out.channels(); ++c) {
        Mean mean;
        for (int v = y * factor; v < std::min((y + 1) * factor, image.height()); ++v)
          for (int u = x * factor; u < std::min((x + 1) * factor, image.width()); ++u)
            mean.add(image.texel(u, v)[static_cast<std::size_t>(c)]);
        out.texel(x, y)[static_cast<std::size_t>(c)] = mean.get();
      }
    }
  }
  return out;
}

BasisMaps make_maps(const std::string& basis, const ComparedPicture& candidate,
                    const ComparedPicture& reference, const std::vector<CountedWhere>& counted, int limit) {
  return {basis, shrink(values_of(candidate, counted), limit), shrink(values_of(reference, counted), limit),
          shrink(noise_of(candidate, counted), limit), shrink(noise_of(reference, counted), limit)};
}

}  // namespace rnmbake
