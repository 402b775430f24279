#include "base/utf8.h"

#include <cstdlib>
#include <memory>
#include <new>

#include <utf8proc.h>

namespace rnmbake {
namespace {

const utf8proc_uint8_t* unsigned_bytes(std::string_view text) {
  return reinterpret_cast<const utf8proc_uint8_t*>(text.data());
}

/// `valid` must be UTF-8; the only error left is then a lack of memory.
std::string folded(std::string_view valid) {
  constexpr auto how = static_cast<utf8proc_option_t>(UTF8PROC_STABLE | UTF8PROC_COMPOSE | UTF8PROC_CASEFOLD |
                                                      UTF8PROC_IGNORE);
  utf8proc_uint8_t* mapped = nullptr;
  const utf8proc_ssize_t size =
      utf8proc_map(unsigned_bytes(valid), static_cast<utf8proc_ssize_t>(valid.size()), &mapped, how);
  const std::unique_ptr<utf8proc_uint8_t, decltype(&std::free)> owner(mapped, &std::free);
  if (size < 0) throw std::bad_alloc();
  return {reinterpret_cast<const char*>(mapped), static_cast<std::size_t>(size)};
}

}  // namespace

CodePoint decode_utf8(std::string_view text, std::size_t at) {
  utf8proc_int32_t value = 0;
  const utf8proc_ssize_t bytes =
      utf8proc_iterate(unsigned_bytes(text) + at, static_cast<utf8proc_ssize_t>(text.size() - at), &value);
  if (bytes <= 0) return {static_cast<unsigned char>(text[at]), 1, false};
  return {static_cast<char32_t>(value), static_cast<std::size_t>(bytes), true};
}

std::string cut_utf8(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return std::string(text);
  std::size_t end = 0;
  while (end < text.size()) {
    const std::size_t next = end + decode_utf8(text, end).bytes;
    if (next > bytes) break;
    end = next;
  }
  return std::string(text.substr(0, end));
}

std::string fold_case(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size()) {
      const CodePoint c = decode_utf8(text, end);
      if (!c.valid) break;
      end += c.bytes;
    }
    if (end > at) {
      out += folded(text.substr(at, end - at));
    } else {
      out += text[end++];
    }
    at = end;
  }
  return out;
}

}  // namespace rnmbake
