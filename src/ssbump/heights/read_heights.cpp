#include "ssbump/heights/read_heights.h"

#include "base/error.h"
#include "base/log.h"
#include "base/names.h"
#include "base/text.h"
#include "image/channels.h"
#include "image/picture_rows.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace rnmbake {
namespace {

constexpr int rows_at_once = 64;  // read at a time

/// Channels of a file from `first` on, weighted: one, or the three of luminance.
struct Source {
  std::string name;
  int first = 0;
  std::vector<float> weights;
};

class Channels {
 public:
  Channels(const PictureFacts& facts, std::string file) : names_(facts.channels), file_(std::move(file)) {}

  [[nodiscard]] Source find(const std::string& wanted) const {
    if (wanted.empty()) return by_names();
    if (lower_case(wanted) == "luminance") {
      if (const auto colour = colour_channels(names_, file_, remedy); !colour.empty())
        return luminance(colour);
    }
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (lower_case(names_[i]) == lower_case(wanted)) return single(static_cast<int>(i));
    constexpr std::array<std::pair<const char*, const char*>, 4> words{
        {{"red", "r"}, {"green", "g"}, {"blue", "b"}, {"alpha", "a"}}};
    for (const auto& [word, letter] : words)
      if (lower_case(wanted) == word && std::ranges::count(names_, letter, lower_case) > 0)
        return find(letter);
    return numbered(wanted);
  }

 private:
  static constexpr const char* remedy = "name a channel with --channel";

  /// The only channel beside alpha; luminance of the colours; brightness where it has a channel of its own.
  [[nodiscard]] Source by_names() const {
    if (names_.size() == 1) return single(0);
    if (const auto colour = colour_channels(names_, file_, remedy); !colour.empty()) return luminance(colour);
    int candidate = -1, candidates = 0;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (is_alpha(names_[i])) continue;
      candidate = static_cast<int>(i);
      ++candidates;
    }
    if (candidates == 1) return single(candidate);
    const bool is_vector = !places_of(names_, "XY").empty();
    if (const auto bright = places_of(names_, "Y"); !bright.empty() && !is_vector)
      return single(bright.front());
    fail(ExitCode::invalid_input, "{}: its channels, {}, do not say which holds the heights; {}", file_,
         listed(names_), remedy);
  }

  static bool is_alpha(const std::string& name) {
    return lower_case(name) == "a" || lower_case(name) == "alpha" || lower_case(name).ends_with(".a");
  }

  /// Weights of the channels from the first of the three to the last, whatever lies between them.
  static Source luminance(const std::vector<int>& colour) {
    constexpr std::array<float, 3> shares{0.2126F, 0.7152F, 0.0722F};
    const auto [first, last] = std::ranges::minmax(colour);
    Source source{"luminance", first, std::vector<float>(static_cast<std::size_t>(last - first + 1))};
    for (std::size_t c = 0; c < shares.size(); ++c)
      source.weights[static_cast<std::size_t>(colour[c] - first)] = shares[c];
    return source;
  }
  [[nodiscard]] Source single(int at) const { return {names_[static_cast<std::size_t>(at)], at, {1}}; }

  [[nodiscard]] Source numbered(const std::string& wanted) const {
    int at = -1;
    const char* end = wanted.data() + wanted.size();
    const auto [parsed, error] = std::from_chars(wanted.data(), end, at);
    if (error == std::errc() && parsed == end && at >= 0 && at < static_cast<int>(names_.size()))
      return single(at);
    const bool is_number = wanted.find_first_not_of("0123456789") == std::string::npos;
    const std::string hint = is_number ? "" : did_you_mean(wanted, names_);
    const std::string there = names_.size() == 1 ? "its only channel is " + names_[0]
                                                 : fmt::format("its channels are {} (or 0 to {})",
                                                               listed(names_), names_.size() - 1);
    fail(ExitCode::usage, "{} has no channel '{}'{} {}", file_, wanted, hint.empty() ? ";" : hint, there);
  }

  std::vector<std::string> names_;
  std::string file_;
};

/// The source's value of each texel of some rows, straight into the heights.
void gather(const std::vector<float>& values, const Source& source, float* out) {
  const std::size_t channels = source.weights.size();
  for (std::size_t at = 0; at < values.size(); at += channels) {
    float sum = 0;
    for (std::size_t c = 0; c < channels; ++c) sum += source.weights[c] * values[at + c];
    *out++ = sum;
  }
}

void check_finite(const std::string& file, const FloatImage& heights, int begin, int end) {
  for (int y = begin; y < end; ++y) {
    for (int x = 0; x < heights.width(); ++x) {
      const float value = heights.texel(x, y)[0];
      if (std::isfinite(value)) continue;
      fail(ExitCode::invalid_input, "{}: texel ({}, {}) from the top left is {}; give every texel a height",
           file, x, y, std::isnan(value) ? "NaN" : "infinite");
    }
  }
}

void read_values(PictureReader& reader, const std::string& file, const Source& source, FloatImage& heights) {
  const auto channels = static_cast<int>(source.weights.size());
  std::vector<float> values;
  for (int begin = 0; begin < heights.height(); begin += rows_at_once) {
    const int end = std::min(begin + rows_at_once, heights.height());
    values.resize(static_cast<std::size_t>(end - begin) * heights.width() * channels);
    reader.read(begin, end, source.first, channels, values);
    gather(values, source, heights.texel(0, begin).data());
    check_finite(file, heights, begin, end);
  }
}

/// A 32nd of the side of a square of as many texels, so that a strip is neither a wall nor flat.
double usual_height(const PictureFacts& facts) {
  return std::sqrt(double(facts.width) * facts.height) / 32;
}

/// 12 bits and fewer in files of 16: cameras and scanners leave the upper bits empty, and the relief is flat.
void warn_if_unused(const std::string& file, const PictureFacts& facts, const ReadHeights& heights) {
  constexpr double most = 65535;
  const auto highest = static_cast<int>(std::lround(heights.highest * most));
  if (facts.storage != "uint16" || highest < 1 || highest > 4095 || heights.lowest == heights.highest) return;
  int bits = 1;
  while (highest >> bits != 0) ++bits;
  log::warn(
      "{}: no value above {} of 65535, as of {} bits in 16, so that heights reach {:.3g} texels; "
      "--height {:.4g} takes {} bits for the full range",
      file, highest, bits, heights.texels * heights.highest, heights.texels * most / ((1 << bits) - 1), bits);
}

void scale(ReadHeights& heights, bool invert) {
  const auto texels = static_cast<float>(heights.texels);
  const float top = heights.is_integer ? 1 : heights.highest;
  for (float& height : heights.field.heights.data()) height = texels * (invert ? top - height : height);
}

void check_scaled(const std::string& file, const ReadHeights& heights) {
  const double range = (double(heights.highest) - heights.lowest) * heights.texels;
  constexpr double largest_range = 1e6;
  if (std::abs(range) <= largest_range) return;
  fail(ExitCode::invalid_input,
       "{}: heights range over {:g} texels, from {:g} to {:g} in the file; set --height, or mend the file",
       file, std::abs(range), heights.lowest, heights.highest);
}

}  // namespace

ReadHeights read_heights(const std::filesystem::path& file, const HeightOptions& options) try {
  PictureReader reader(file);
  const PictureFacts& facts = reader.facts();
  const Source source = Channels(facts, file.string()).find(options.channel);
  ReadHeights read;
  read.field = {FloatImage(facts.width, facts.height, 1), options.x, options.y};
  read.channel = source.name;
  read.is_integer = facts.is_integer;
  read.texels = options.texels.value_or(facts.is_integer ? usual_height(facts) : 1.0);
  read_values(reader, file.string(), source, read.field.heights);
  const auto [low, high] = std::ranges::minmax(read.field.heights.data());
  read.lowest = low;
  read.highest = high;
  check_scaled(file.string(), read);
  if (!options.texels) warn_if_unused(file.string(), facts, read);
  scale(read, options.invert);
  return read;
} catch (const std::bad_alloc&) {
  fail(ExitCode::invalid_input, "the heights of {} do not fit into memory; scale it down", file.string());
}

}  // namespace rnmbake
