// The glob of base/names.h: one pass with a single point to return to, so that no pattern takes long.
#include "base/names.h"
#include "base/utf8.h"

namespace rnmbake {

namespace {

constexpr std::size_t nowhere = std::string_view::npos;

/// Whether the set that opens at `at` ("[...]") holds `c`; moves `at` past it. A "[" that is never closed
/// stands for itself.
bool set_holds(std::string_view pattern, std::size_t& at, char32_t c) {
  std::size_t i = at + 1;
  const bool negated = i < pattern.size() && (pattern[i] == '!' || pattern[i] == '^');
  if (negated) ++i;
  const std::size_t close = pattern.find(']', i + 1);  // "[]a]" holds "]"
  if (close == nowhere) {
    ++at;
    return c == '[';
  }
  bool found = false;
  while (i < close) {
    const CodePoint low = decode_utf8(pattern, i);
    i += low.bytes;
    CodePoint high = low;
    if (i + 1 < close && pattern[i] == '-') {
      high = decode_utf8(pattern, i + 1);
      i += 1 + high.bytes;
    }
    found = found || (low.value <= c && c <= high.value);
  }
  at = close + 1;
  return found != negated;
}

/// Whether the one pattern element at `at` accepts `c`; moves `at` past the element.
bool one_matches(std::string_view pattern, std::size_t& at, char32_t c) {
  if (pattern[at] == '[') return set_holds(pattern, at, c);
  const CodePoint wanted = decode_utf8(pattern, at);
  at += wanted.bytes;
  return wanted.value == '?' || wanted.value == c;
}

}  // namespace

bool glob_match(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0;
  std::size_t star = nowhere, star_text = 0;  // behind the last "*", and where its run ends so far
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = ++p;
      star_text = t;
      continue;
    }
    const CodePoint c = decode_utf8(text, t);
    if (p < pattern.size() && one_matches(pattern, p, c.value)) {
      t += c.bytes;
      continue;
    }
    if (star == nowhere) return false;
    star_text += decode_utf8(text, star_text).bytes;
    p = star;
    t = star_text;
  }
  return pattern.find_first_not_of('*', p) == nowhere;
}

}  // namespace rnmbake
