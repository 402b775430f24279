// base/bytes.h - numbers in memory as the bytes that they are.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace rnmbake {

template <typename T>
[[nodiscard]] std::string_view bytes_of(const std::vector<T>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace rnmbake
