#include "texture/block_compression.h"

#include "texture/block_bits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

namespace rnmbake {
namespace {

constexpr int side_length = 4;  // texels of a block
constexpr std::size_t texel_count = 16;

using Colour = std::array<float, 3>;  // 0 to 255
using Block = std::array<Colour, texel_count>;

Colour operator+(const Colour& a, const Colour& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Colour operator-(const Colour& a, const Colour& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Colour operator*(const Colour& a, float s) {
  return {a[0] * s, a[1] * s, a[2] * s};
}
float dot(const Colour& a, const Colour& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

float rounded(float value, float steps) {
  return std::nearbyint(std::clamp(value, 0.0F, 255.0F) * steps / 255);
}

/// 5 or 6 bits become 8 by repeating the upper ones below.
float widened(float value, int bits) {
  const int whole = static_cast<int>(value);
  return static_cast<float>((whole << (8 - bits)) | (whole >> (2 * bits - 8)));
}

/// The nearest colour that a format can hold as an end point.
Colour as_565(const Colour& colour) {
  return {widened(rounded(colour[0], 31), 5), widened(rounded(colour[1], 63), 6),
          widened(rounded(colour[2], 31), 5)};
}

/// 7 bits for each channel and one for all of them, which alpha (255) sets to 1.
Colour as_7_and_shared(const Colour& colour) {
  Colour near{};
  for (std::size_t c = 0; c < 3; ++c)
    near[c] = 2 * std::clamp(std::nearbyint((colour[c] - 1) / 2), 0.0F, 127.0F) + 1;
  return near;
}

struct Ends {
  Colour first{}, second{};
};

/// A format with two end points in a block and steps between.
struct Palette {
  Colour (*held)(const Colour&);
  std::vector<float> steps;               // shares of `second`
  Colour (*between)(const Ends&, float);  // as the hardware rounds
};

Colour bc1_between(const Ends& ends, float share) {
  return ends.first * (1 - share) + ends.second * share;  // thirds; hardware differs in how it rounds
}

/// BC7's weights are 64ths, rounded to whole numbers.
Colour bc7_between(const Ends& ends, float share) {
  Colour colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = std::floor((ends.first[c] * (64 - 64 * share) + ends.second[c] * 64 * share + 32) / 64);
  return colour;
}

/// End points of so many bits, each channel for itself.
template <int bits>
Colour as_bits(const Colour& colour) {
  Colour near{};
  for (std::size_t c = 0; c < 3; ++c) {
    const float whole = rounded(colour[c], (1 << bits) - 1);
    near[c] = bits == 8 ? whole : widened(whole, bits);
  }
  return near;
}

const std::vector<float>& bc7_steps(int bits) {
  const auto of = [](std::initializer_list<int> weights) {
    std::vector<float> steps;
    for (const int weight : weights) steps.push_back(static_cast<float>(weight) / 64);
    return steps;
  };
  static const auto two = of({0, 21, 43, 64}), three = of({0, 9, 18, 27, 37, 46, 55, 64});
  static const auto four = of({0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64});
  return bits == 2 ? two : bits == 3 ? three : four;
}

const Palette& bc1_palette() {
  static const Palette palette{as_565, {0, 1.0F / 3, 2.0F / 3, 1}, bc1_between};
  return palette;
}

const Palette& bc7_palette() {
  static const Palette palette{as_7_and_shared, bc7_steps(4), bc7_between};
  return palette;
}

/// BC7's modes 5 and 4: one channel, which may be any, has end points and steps of its own.
struct Split {
  Palette two, one;
  Bc7LineBits two_bits, one_bits;
};
const std::vector<Split>& bc7_splits() {
  static const std::vector<Split> splits{
      {{as_bits<7>, bc7_steps(2), bc7_between}, {as_bits<8>, bc7_steps(2), bc7_between}, {7, 2}, {8, 2}},
      {{as_bits<5>, bc7_steps(2), bc7_between}, {as_bits<6>, bc7_steps(3), bc7_between}, {5, 2}, {6, 3}},
      {{as_bits<5>, bc7_steps(3), bc7_between}, {as_bits<6>, bc7_steps(2), bc7_between}, {5, 3}, {6, 2}}};
  return splits;
}

struct Encoded {
  Ends ends;  // as held
  std::array<std::size_t, texel_count> step{};
  Block colours{};
  float error = std::numeric_limits<float>::infinity();
};

Encoded encoded(const Block& block, const Palette& palette, const Ends& wanted) {
  const Ends ends{palette.held(wanted.first), palette.held(wanted.second)};
  std::vector<Colour> colours;
  for (const float step : palette.steps) colours.push_back(palette.between(ends, step));
  Encoded result{.ends = ends};
  result.error = 0;
  for (std::size_t i = 0; i < texel_count; ++i) {
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t s = 0; s < colours.size(); ++s) {
      const Colour off = block[i] - colours[s];
      if (const float error = dot(off, off); error < least) {
        least = error;
        result.step[i] = s;
      }
    }
    result.colours[i] = colours[result.step[i]];
    result.error += least;
  }
  return result;
}

/// The direction in which the block varies most: power iteration on the covariance.
Colour principal_axis(const Block& block, const Colour& mean) {
  std::array<Colour, 3> covariance{};
  for (const Colour& colour : block) {
    const Colour off = colour - mean;
    for (std::size_t r = 0; r < 3; ++r) covariance[r] = covariance[r] + off * off[r];
  }
  Colour axis{1, 1, 1};
  const auto* longest =
      &*std::ranges::max_element(covariance, {}, [](const Colour& row) { return dot(row, row); });
  if (dot(*longest, *longest) > 0) axis = *longest;
  for (int i = 0; i < 8; ++i) {
    const Colour next{dot(covariance[0], axis), dot(covariance[1], axis), dot(covariance[2], axis)};
    const float length = std::sqrt(dot(next, next));
    if (!(length > 0)) break;
    axis = next * (1 / length);
  }
  return axis * (1 / std::sqrt(dot(axis, axis)));
}

Ends along_axis(const Block& block) {
  Colour mean{};
  for (const Colour& colour : block) mean = mean + colour * (1.0F / texel_count);
  const Colour axis = principal_axis(block, mean);
  float low = 0, high = 0;
  for (const Colour& colour : block) {
    const float at = dot(colour - mean, axis);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return {mean + axis * low, mean + axis * high};
}

/// The end points that fit best to the steps chosen.
Ends refined(const Block& block, const Encoded& encoded, const Palette& palette, const Ends& ends) {
  float aa = 0, ab = 0, bb = 0;
  Colour ac{}, bc{};
  for (std::size_t i = 0; i < texel_count; ++i) {
    const float b = palette.steps[encoded.step[i]], a = 1 - b;
    aa += a * a;
    ab += a * b;
    bb += b * b;
    ac = ac + block[i] * a;
    bc = bc + block[i] * b;
  }
  const float determinant = aa * bb - ab * ab;
  if (!(std::abs(determinant) > 1e-4F)) return ends;
  return {(ac * bb - bc * ab) * (1 / determinant), (bc * aa - ac * ab) * (1 / determinant)};
}

Encoded compressed(const Block& block, const Palette& palette) {
  Ends ends = along_axis(block);
  Encoded best = encoded(block, palette, ends);
  for (int i = 0; i < 3; ++i) {
    ends = refined(block, best, palette, ends);
    Encoded next = encoded(block, palette, ends);
    if (next.error >= best.error) break;
    best = next;
  }
  return best;
}

BlockLine line_of(const Encoded& encoded) {
  BlockLine line;
  for (std::size_t c = 0; c < 3; ++c) {
    line.ends[0][c] = static_cast<int>(encoded.ends.first[c]);
    line.ends[1][c] = static_cast<int>(encoded.ends.second[c]);
  }
  std::ranges::transform(encoded.step, line.step.begin(),
                         [](std::size_t step) { return static_cast<int>(step); });
  return line;
}

/// What a block looks like, and its bits.
struct Compressed {
  Block colours{};
  float error = std::numeric_limits<float>::infinity();
  std::vector<std::uint8_t> bits;
};

/// `alone` has its own line through the block, the other two share one.
Compressed split(const Block& block, const Split& how, std::size_t alone) {
  Block two = block, one{};
  for (std::size_t i = 0; i < texel_count; ++i) std::swap(two[i][alone], one[i][alone]);
  const Encoded first = compressed(two, how.two), other = compressed(one, how.one);
  Compressed result{first.colours, first.error + other.error,
                    bc7_split_bits(line_of(first), how.two_bits, line_of(other), how.one_bits, alone)};
  for (std::size_t i = 0; i < texel_count; ++i) result.colours[i][alone] = other.colours[i][alone];
  return result;
}

Compressed best_of(TextureFormat format, const Block& block) {
  if (format == TextureFormat::bc1) {
    const Encoded line = compressed(block, bc1_palette());
    return {line.colours, line.error, bc1_bits(line_of(line))};
  }
  const Encoded line = compressed(block, bc7_palette());
  Compressed best{line.colours, line.error, bc7_bits(line_of(line))};
  for (const Split& how : bc7_splits()) {
    for (std::size_t alone = 0; alone < 3; ++alone) {
      Compressed next = split(block, how, alone);
      if (next.error < best.error) best = std::move(next);
    }
  }
  return best;
}

/// The texel that stands at place `i` of a block.
std::pair<int, int> texel_at(const FloatImage& image, int left, int top, std::size_t i) {
  return {std::min(left + static_cast<int>(i) % side_length, image.width() - 1),
          std::min(top + static_cast<int>(i) / side_length, image.height() - 1)};
}

Compressed compressed_at(const FloatImage& image, int left, int top, TextureFormat format) {
  Block block{};
  for (std::size_t i = 0; i < texel_count; ++i) {
    const auto [x, y] = texel_at(image, left, top, i);
    for (std::size_t c = 0; c < 3; ++c) block[i][c] = rounded(255 * image.texel(x, y)[c], 255);
  }
  return best_of(format, block);
}

/// Steps of each channel.
FloatImage rounded_to(const FloatImage& image, TextureFormat format) {
  FloatImage out(image.width(), image.height(), 3);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const auto in = image.texel(x, y);
      Colour colour{255 * in[0], 255 * in[1], 255 * in[2]};
      colour = format == TextureFormat::rgb565
                   ? as_565(colour)
                   : Colour{rounded(colour[0], 255), rounded(colour[1], 255), rounded(colour[2], 255)};
      for (std::size_t c = 0; c < 3; ++c) out.texel(x, y)[c] = colour[c] / 255;
    }
  }
  return out;
}

}  // namespace

const char* name_of(TextureFormat format) {
  constexpr std::array names{"RGB8", "RGB565", "BC1", "BC7"};
  return names[static_cast<std::size_t>(format)];
}

double bits_per_texel(TextureFormat format) {
  constexpr std::array bits{24.0, 16.0, 4.0, 8.0};
  return bits[static_cast<std::size_t>(format)];
}

FloatImage through(TextureFormat format, const FloatImage& image) {
  if (format == TextureFormat::rgb8 || format == TextureFormat::rgb565) return rounded_to(image, format);
  FloatImage out(image.width(), image.height(), 3);
  for (int top = 0; top < image.height(); top += side_length) {
    for (int left = 0; left < image.width(); left += side_length) {
      const Block colours = compressed_at(image, left, top, format).colours;
      for (std::size_t i = 0; i < texel_count; ++i) {
        const auto [x, y] = texel_at(image, left, top, i);
        for (std::size_t c = 0; c < 3; ++c) out.texel(x, y)[c] = colours[i][c] / 255;
      }
    }
  }
  return out;
}

std::vector<std::uint8_t> blocks_of(TextureFormat format, const FloatImage& image) {
  std::vector<std::uint8_t> blocks;
  for (int top = 0; top < image.height(); top += side_length) {
    for (int left = 0; left < image.width(); left += side_length) {
      const auto bits = compressed_at(image, left, top, format).bits;
      blocks.insert(blocks.end(), bits.begin(), bits.end());
    }
  }
  return blocks;
}

}  // namespace rnmbake
