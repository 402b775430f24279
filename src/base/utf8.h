// base/utf8.h - the little of UTF-8 that names need: decode, check, fold case.
#pragma once

#include <cstddef>
#include <string_view>

namespace rnmbake {

struct CodePoint {
  char32_t value = 0;
  std::size_t bytes = 1;
  bool valid = false;  // false: `value` is the single byte at hand
};

/// The character at `at`, which must be inside the text. Overlong forms, surrogates and cut sequences are
/// invalid.
CodePoint decode_utf8(std::string_view text, std::size_t at);

/// Lower case of the alphabets that have it and that people use in names (Latin, Greek, Cyrillic).
char32_t fold_case(char32_t c);

}  // namespace rnmbake
