#include "texture/bc6h.h"

#include "texture/bc6h_bits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include <half.h>

namespace rnmbake {
namespace {

constexpr int side_length = 4;  // texels of a block
constexpr std::size_t texel_count = 16, step_count = 16;
constexpr float most_half = 65504;

using Channels = std::array<std::array<float, texel_count>, 3>;  // of each channel, by texel or step

float value_of(std::uint16_t bits) {
  half value;
  value.setBits(bits);
  return value;
}

/// How much a half float changes with its bits.
float slope_at(float value) {
  const int exponent = (half(std::abs(value)).bits() & 0x7C00) >> 10;
  return std::ldexp(1.0F, std::max(exponent, 1) - 25);
}

/// What is to be encoded. "Wide" are the numbers that the format interpolates: bits of half floats, stretched
/// to 16 bits.
struct Source {
  bool is_signed = false;
  Channels value{}, wide{};
  std::array<float, texel_count> importance{};  // of an error: one over the texel's brightness

  [[nodiscard]] float stretch() const { return is_signed ? 32.0F / 31 : 64.0F / 31; }
};

float held(float value, bool is_signed) {
  if (std::isnan(value)) return 0;
  return std::clamp(value, is_signed ? -most_half : 0.0F, most_half);
}

Source source_at(const FloatImage& image, int left, int top, bool is_signed) {
  Source source{.is_signed = is_signed};
  std::array<float, texel_count> brightness{};
  for (std::size_t i = 0; i < texel_count; ++i) {
    const auto texel = image.texel(std::min(left + static_cast<int>(i) % side_length, image.width() - 1),
                                   std::min(top + static_cast<int>(i) / side_length, image.height() - 1));
    for (std::size_t c = 0; c < 3; ++c) {
      const half value = held(texel[c], is_signed);
      source.value[c][i] = value;
      brightness[i] = std::max(brightness[i], std::abs(float(value)));
      const float wide = (float(value.bits() & 0x7FFF) + 0.5F) * source.stretch();
      source.wide[c][i] = value.isNegative() ? -wide : wide;
    }
  }
  const float brightest = *std::ranges::max_element(brightness);
  for (std::size_t i = 0; i < texel_count; ++i)
    source.importance[i] = 1 / std::max({brightness[i], brightest / 16, 1e-7F});
  return source;
}

using Ends = std::array<std::array<float, 3>, 2>;  // wide

/// The stored number whose widened one is nearest.
int stored(float wide, int bits, bool is_signed) {
  const float magnitude = std::abs(is_signed ? wide : std::max(wide, 0.0F));
  const int most = (1 << (is_signed ? bits - 1 : bits)) - 1;
  if (bits >= 16) return static_cast<int>(std::copysign(std::min(std::round(magnitude), float(most)), wide));
  const float in_steps = std::ldexp(magnitude, bits - 16);
  const int near = in_steps < 0.75F ? 0 : std::clamp(static_cast<int>(in_steps), 1, most);
  return wide < 0 ? -near : near;
}

struct Encoded {
  Bc6hMode mode;
  Bc6hLine line;
  Channels wide{}, value{};  // of the steps
  float error = std::numeric_limits<float>::infinity();
};

void set_steps(Encoded& encoded, bool is_signed) {
  for (std::size_t c = 0; c < 3; ++c) {
    const int bits = encoded.mode.end_bits;
    const int first = bc6h_widened(encoded.line.ends[0][c], bits, is_signed);
    const int second = bc6h_widened(encoded.line.ends[1][c], bits, is_signed);
    for (std::size_t s = 0; s < step_count; ++s) {
      const std::uint16_t half_bits = bc6h_half(first, second, s, is_signed);
      encoded.value[c][s] = value_of(half_bits);
      encoded.wide[c][s] = (float(half_bits & 0x7FFF) + 0.5F) * (is_signed ? 32.0F / 31 : 64.0F / 31);
      if ((half_bits & 0x8000) != 0) encoded.wide[c][s] *= -1;
    }
  }
}

/// The best step for each texel, and the error of all.
void choose_steps(const Source& source, Encoded& encoded) {
  encoded.error = 0;
  for (std::size_t i = 0; i < texel_count; ++i) {
    std::array<float, step_count> off{};
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = source.value[c][i];
      for (std::size_t s = 0; s < step_count; ++s)
        off[s] += (encoded.value[c][s] - value) * (encoded.value[c][s] - value);
    }
    const auto* const least = std::ranges::min_element(off);
    encoded.line.step[i] = static_cast<int>(least - off.begin());
    encoded.error += *least * source.importance[i] * source.importance[i];
  }
}

/// Of infinite error where the mode cannot hold the end points.
Encoded encode(const Source& source, const Bc6hMode& mode, const Ends& ends) {
  Encoded encoded;
  encoded.mode = mode;
  for (std::size_t e = 0; e < 2; ++e)
    for (std::size_t c = 0; c < 3; ++c)
      encoded.line.ends[e][c] = stored(ends[e][c], mode.end_bits, source.is_signed);
  if (!fits(mode, encoded.line)) return encoded;
  set_steps(encoded, source.is_signed);
  choose_steps(source, encoded);
  return encoded;
}

/// The direction in which the block varies most, each channel weighted by what its bits mean for light.
std::array<float, 3> principal_axis(const Source& source, const std::array<float, 3>& mean,
                                    const std::array<float, 3>& weight) {
  std::array<std::array<float, 3>, 3> covariance{};
  for (std::size_t i = 0; i < texel_count; ++i) {
    std::array<float, 3> off{};
    for (std::size_t c = 0; c < 3; ++c) off[c] = (source.wide[c][i] - mean[c]) * weight[c];
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) covariance[r][c] += off[r] * off[c];
  }
  std::size_t strongest = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (covariance[c][c] > covariance[strongest][strongest]) strongest = c;
  std::array<float, 3> axis = covariance[strongest];
  for (int i = 0; i < 8; ++i) {
    std::array<float, 3> next{};
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) next[r] += covariance[r][c] * axis[c];
    const float length = std::hypot(next[0], next[1], next[2]);
    if (!(length > 0)) return {1, 1, 1};
    for (std::size_t c = 0; c < 3; ++c) axis[c] = next[c] / length;
  }
  return axis;
}

Ends along_axis(const Source& source) {
  std::array<float, 3> mean{}, weight{};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < texel_count; ++i) {
      mean[c] += source.wide[c][i] / texel_count;
      const float meant = slope_at(source.value[c][i]) * source.importance[i];
      weight[c] += meant * meant;
    }
    weight[c] = std::sqrt(weight[c]);
  }
  const std::array<float, 3> axis = principal_axis(source, mean, weight);
  float low = 0, high = 0;
  for (std::size_t i = 0; i < texel_count; ++i) {
    float at = 0;
    for (std::size_t c = 0; c < 3; ++c) at += (source.wide[c][i] - mean[c]) * weight[c] * axis[c];
    low = std::min(low, at);
    high = std::max(high, at);
  }
  const float square = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
  Ends ends;
  for (std::size_t c = 0; c < 3; ++c) {
    const float along = axis[c] / (square * weight[c]);
    ends[0][c] = mean[c] + low * along;
    ends[1][c] = mean[c] + high * along;
  }
  return ends;
}

/// What an error of a texel's wide number means for light: by the way from what is seen to what should be.
float weight_of(const Source& source, const Encoded& encoded, std::size_t c, std::size_t i) {
  const auto step = static_cast<std::size_t>(encoded.line.step[i]);
  const float way = source.wide[c][i] - encoded.wide[c][step];
  const float slope = std::abs(way) < 4 ? slope_at(source.value[c][i]) / source.stretch()
                                        : (source.value[c][i] - encoded.value[c][step]) / way;
  const float meant = slope * source.importance[i];
  return meant * meant;
}

/// The end points that fit best to the steps chosen.
Ends refined(const Source& source, const Encoded& encoded, const Ends& ends) {
  Ends better = ends;
  for (std::size_t c = 0; c < 3; ++c) {
    double aa = 0, ab = 0, bb = 0, ax = 0, bx = 0;
    for (std::size_t i = 0; i < texel_count; ++i) {
      const double w = weight_of(source, encoded, c, i);
      const double b = encoded.line.step[i] / 15.0, a = 1 - b;
      aa += w * a * a;
      ab += w * a * b;
      bb += w * b * b;
      ax += w * a * double(source.wide[c][i]);
      bx += w * b * double(source.wide[c][i]);
    }
    const double determinant = aa * bb - ab * ab;
    if (!(determinant > 1e-6 * aa * bb)) continue;
    better[0][c] = static_cast<float>((ax * bb - bx * ab) / determinant);
    better[1][c] = static_cast<float>((bx * aa - ax * ab) / determinant);
  }
  return better;
}

/// By the finest mode that reaches from end to end.
Encoded best_of(const Source& source) {
  const Ends start = along_axis(source);
  Encoded best;
  for (auto mode = bc6h_modes().rbegin(); mode != bc6h_modes().rend() && std::isinf(best.error); ++mode) {
    Ends ends = start;
    best = encode(source, *mode, ends);
    for (int i = 0; i < 4 && std::isfinite(best.error); ++i) {
      ends = refined(source, best, ends);
      const Encoded next = encode(source, *mode, ends);
      if (next.error >= best.error) break;
      best = next;
    }
  }
  return best;
}

std::size_t blocks_along(int texels) {
  return static_cast<std::size_t>((texels + side_length - 1) / side_length);
}

}  // namespace

std::vector<std::uint8_t> bc6h_block_row(const FloatImage& image, int row, bool is_signed) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(bc6h_block_bytes * blocks_along(image.width()));
  for (int left = 0; left < image.width(); left += side_length) {
    const Encoded best = best_of(source_at(image, left, row * side_length, is_signed));
    const std::vector<std::uint8_t> bits = bc6h_bits(best.mode, best.line);
    bytes.insert(bytes.end(), bits.begin(), bits.end());
  }
  return bytes;
}

std::vector<std::uint8_t> bc6h_blocks(const FloatImage& image, bool is_signed) {
  std::vector<std::uint8_t> bytes;
  for (int row = 0; row * side_length < image.height(); ++row) {
    const std::vector<std::uint8_t> more = bc6h_block_row(image, row, is_signed);
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
  return bytes;
}

FloatImage bc6h_decoded(std::span<const std::uint8_t> blocks, int width, int height, bool is_signed) {
  const std::size_t across = blocks_along(width);
  if (blocks.size() < bc6h_block_bytes * across * blocks_along(height))
    throw std::invalid_argument("fewer blocks than the picture has");
  FloatImage image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int left = 0; left < width; left += side_length) {
      const std::size_t block =
          static_cast<std::size_t>(y / side_length) * across + static_cast<std::size_t>(left / side_length);
      const auto halves = bc6h_halves(std::span<const std::uint8_t, bc6h_block_bytes>(
                                          blocks.subspan(bc6h_block_bytes * block, bc6h_block_bytes)),
                                      is_signed);
      for (int x = left; x < std::min(left + side_length, width); ++x) {
        const auto i = static_cast<std::size_t>(y % side_length * side_length + x - left);
        for (std::size_t c = 0; c < 3; ++c) image.texel(x, y)[c] = value_of(halves[3 * i + c]);
      }
    }
  }
  return image;
}

}  // namespace rnmbake
