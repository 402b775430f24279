// tests/fuzz/parts.h - a .rnmscene file taken apart into JSON and data, and put together again.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace rnmbake::fuzz {

struct Parts {
  std::string text, data;
};

inline constexpr std::string_view file_start("rnmscene\2\0\0\0\0\0\0\0", 16);
inline constexpr std::size_t header_bytes = 32, checksum_bytes = 8;

/// Whatever the sizes in the header say, all bytes are in one of the two parts.
inline Parts take_apart(const std::uint8_t* bytes, std::size_t size) {
  if (size < header_bytes + checksum_bytes) return {};
  std::uint64_t text_bytes = 0;
  std::memcpy(&text_bytes, bytes + 16, sizeof(text_bytes));
  const std::size_t room = size - header_bytes - checksum_bytes;
  const auto split = static_cast<std::size_t>(std::min<std::uint64_t>(text_bytes, room));
  const char* start = reinterpret_cast<const char*>(bytes) + header_bytes;
  return {std::string(start, split), std::string(start + split, room - split)};
}

/// A file with the right sizes; its checksum is nothing.
inline std::string put_together(const Parts& parts) {
  const std::uint64_t sizes[] = {parts.text.size(), parts.data.size()};
  std::string file(file_start);
  file.append(reinterpret_cast<const char*>(sizes), sizeof(sizes));
  return file + parts.text + parts.data + std::string(checksum_bytes, '\0');
}

}  // namespace rnmbake::fuzz
