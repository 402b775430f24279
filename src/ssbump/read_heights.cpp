#include "ssbump/read_heights.h"

#include "base/error.h"
#include "base/names.h"
#include "image/picture_rows.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

constexpr int kRows = 64;  // read at a time

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Channels of a file, weighted: one, or the three of luminance.
struct Source {
  std::string name;
  int first = 0;
  std::vector<float> weights;
};

class Channels {
 public:
  Channels(const PictureFacts& facts, std::string file) : names_(facts.channels), file_(std::move(file)) {}

  [[nodiscard]] Source find(const std::string& wanted) const {
    if (wanted.empty()) return has_colour() ? luminance() : single(0);
    if (lower(wanted) == "luminance" && has_colour()) return luminance();
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (lower(names_[i]) == lower(wanted)) return single(static_cast<int>(i));
    constexpr std::array<std::pair<const char*, const char*>, 4> words{
        {{"red", "r"}, {"green", "g"}, {"blue", "b"}, {"alpha", "a"}}};
    for (const auto& [word, letter] : words)
      if (lower(wanted) == word && std::ranges::count(names_, letter, lower) > 0) return find(letter);
    return numbered(wanted);
  }

 private:
  [[nodiscard]] bool has_colour() const {
    return names_.size() >= 3 && lower(names_[0]) == "r" && lower(names_[1]) == "g" &&
           lower(names_[2]) == "b";
  }
  static Source luminance() { return {"luminance", 0, {0.2126F, 0.7152F, 0.0722F}}; }
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
                                                               fmt::join(names_, ", "), names_.size() - 1);
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
  for (int begin = 0; begin < heights.height(); begin += kRows) {
    const int end = std::min(begin + kRows, heights.height());
    values.resize(static_cast<std::size_t>(end - begin) * heights.width() * channels);
    reader.read(begin, end, source.first, channels, values);
    gather(values, source, heights.texel(0, begin).data());
    check_finite(file, heights, begin, end);
  }
}

void scale(ReadHeights& heights, bool invert) {
  const auto texels = static_cast<float>(heights.texels);
  const float top = heights.is_integer ? 1 : heights.highest;
  for (float& height : heights.field.heights.data()) height = texels * (invert ? top - height : height);
}

void check_scaled(const std::string& file, const ReadHeights& heights) {
  const double range = (double(heights.highest) - heights.lowest) * heights.texels;
  constexpr double kMost = 1e6;
  if (std::abs(range) <= kMost) return;
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
  read.texels = options.texels.value_or(facts.is_integer ? facts.width / 32.0 : 1.0);
  read_values(reader, file.string(), source, read.field.heights);
  const auto [low, high] = std::ranges::minmax(read.field.heights.data());
  read.lowest = low;
  read.highest = high;
  check_scaled(file.string(), read);
  scale(read, options.invert);
  return read;
} catch (const std::bad_alloc&) {
  fail(ExitCode::invalid_input, "the heights of {} do not fit into memory; scale it down", file.string());
}

}  // namespace rnmbake
