// base/utf8.h - UTF-8 that may be broken: decode, check, cut, compare without regard to case.
#pragma once

#include <cstddef>
#include <string>
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

/// At most `bytes` bytes of a UTF-8 text, never half a character.
std::string cut_utf8(std::string_view text, std::size_t bytes);

/// The same for texts that differ in case alone, in whether accents are composed, or in characters that are
/// not seen (soft hyphens, joiners): Unicode's full case folding and NFC without default ignorable
/// characters. Bytes that are no UTF-8 stay as they are.
std::string fold_case(std::string_view text);

}  // namespace rnmbake
