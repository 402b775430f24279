#include "base/text.h"

#include "base/utf8.h"

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

std::string plural_of(std::string_view noun) {
  const auto ends = [&](std::string_view ending) { return noun.ends_with(ending); };
  if (ends("is")) return std::string(noun.substr(0, noun.size() - 2)) + "es";  // basis, axis
  if (ends("s") || ends("x") || ends("ch") || ends("sh")) return std::string(noun) + "es";
  const bool after_vowel =
      noun.size() > 1 && std::string_view("aeiou").find(noun[noun.size() - 2]) != std::string_view::npos;
  if (ends("y") && !after_vowel) return std::string(noun.substr(0, noun.size() - 1)) + "ies";
  return std::string(noun) + "s";
}

/// C0, DEL and C1; line and paragraph separators; what turns the direction of the text that follows.
bool is_control(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
}

}  // namespace

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}", count, count == 1 ? std::string(noun) : plural_of(noun));
}

std::string printable(std::string_view text, bool keep_lines) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const CodePoint c = decode_utf8(text, at);
    const bool is_break = c.value == '\n' && keep_lines;
    if (c.valid && (is_break || !is_control(c.value))) {
      out += text.substr(at, c.bytes);
    } else {
      out += c.value > 0xFF ? fmt::format("\\u{:04x}", static_cast<unsigned>(c.value))
                            : fmt::format("\\x{:02x}", static_cast<unsigned>(c.value));
    }
    at += c.bytes;
  }
  return out;
}

std::string valid_utf8(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const CodePoint c = decode_utf8(text, at);
    out += c.valid ? text.substr(at, c.bytes) : "\xEF\xBF\xBD";
    at += c.bytes;
  }
  return out;
}

std::string shortened(std::string_view text, std::size_t bytes) {
  return text.size() <= bytes ? std::string(text) : cut_utf8(text, bytes) + "...";
}

std::string lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

std::string lower_extension(const std::filesystem::path& file) {
  return lower_case(file.extension().string());
}

}  // namespace rnmbake
