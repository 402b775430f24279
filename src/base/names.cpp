#include "base/names.h"

#include "base/hash.h"
#include "base/text.h"
#include "base/utf8.h"

#include <algorithm>
#include <array>
#include <numeric>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

namespace {

bool harmful(const CodePoint& c) {
  static constexpr std::u32string_view forbidden = U"/\\:*?\"<>|";
  const bool control = c.value < 0x20 || (c.value >= 0x7F && c.value < 0xA0);
  // Line and paragraph separators and the marks that turn the direction of writing can disguise a name.
  const bool disguise = (c.value >= 0x2028 && c.value <= 0x202E) || (c.value >= 0x2066 && c.value <= 0x2069);
  return !c.valid || control || disguise || forbidden.find(c.value) != std::u32string_view::npos;
}

bool reserved_by_windows(std::string_view stem) {
  const std::string base = lower_case(std::string(stem.substr(0, stem.find('.'))));
  if (base.size() == 4 && base[3] >= '0' && base[3] <= '9') {
    return base.compare(0, 3, "com") == 0 || base.compare(0, 3, "lpt") == 0;
  }
  static constexpr std::array names = {"con", "prn", "aux", "nul"};
  return std::any_of(names.begin(), names.end(), [&](const char* name) { return base == name; });
}

std::string harmless(std::string_view name) {
  std::string out;
  for (std::size_t i = 0; i < name.size();) {
    const CodePoint c = decode_utf8(name, i);
    const bool dot_too_many = c.value == '.' && (out.empty() || out.back() == '.');
    const bool looks_like_flag = c.value == '-' && out.empty();
    if (harmful(c) || dot_too_many || looks_like_flag) {
      out += '_';
    } else {
      out += name.substr(i, c.bytes);
    }
    i += c.bytes;
  }
  while (!out.empty() && (out.back() == '.' || out.back() == ' ')) out.pop_back();  // Windows drops them
  return cut_utf8(out, FileStems::max_bytes);
}

std::string presentable(const std::string& stem) {
  if (stem.empty()) return "unnamed";
  return reserved_by_windows(stem) ? fmt::format("_{}", stem) : stem;
}

}  // namespace

FileStems::FileStems(const std::vector<std::string>& taken) {
  for (const std::string& stem : taken) taken_.insert(fold_case(stem));
}

std::string FileStems::take(std::string_view name) {
  std::string stem = presentable(harmless(name));
  if (stem == name && taken_.insert(fold_case(stem)).second) return stem;
  for (int attempt = 0;; ++attempt) {
    const std::string hash =
        short_hash(attempt == 0 ? std::string(name) : fmt::format("{}#{}", name, attempt));
    std::string candidate = fmt::format("{}-{}", cut_utf8(stem, max_bytes - hash.size() - 1), hash);
    if (taken_.insert(fold_case(candidate)).second) return candidate;
  }
}

namespace {

std::vector<char32_t> characters(std::string_view text) {
  std::vector<char32_t> out;
  for (std::size_t i = 0; i < text.size();) {
    const CodePoint c = decode_utf8(text, i);
    out.push_back(c.value);
    i += c.bytes;
  }
  return out;
}

/// Optimal string alignment distance.
std::size_t edit_distance(const std::vector<char32_t>& a, const std::vector<char32_t>& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(now);
  }
  return last[b.size()];
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view word, const std::vector<std::string>& candidates) {
  const auto wanted = characters(fold_case(word));
  std::optional<std::string> best;
  std::size_t best_distance = std::max<std::size_t>(1, wanted.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(wanted, characters(fold_case(candidate)));
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const auto best = nearest_name(word, candidates);
  return best ? fmt::format(", did you mean '{}'?", *best) : "";
}

std::string file_word(std::string_view label) {
  std::string word;
  for (const char c : lower_case(std::string(label))) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (is_plain) word += c;
    if (!is_plain && !word.empty() && word.back() != '-') word += '-';
  }
  return word;
}

}  // namespace rnmbake
