// base/bytes.h - numbers in memory as the bytes that they are.
#pragma once

#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace rnmbake {

template <typename T>
[[nodiscard]] std::string_view bytes_of(const std::vector<T>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

template <typename T>
void put(std::string& bytes, const T& value) {
  static_assert(std::is_standard_layout_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Takes values off the front of bytes, as long as there are enough of them.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename T>
  [[nodiscard]] bool take(T& value) {
    static_assert(std::is_standard_layout_v<T>);
    if (bytes_.size() < sizeof value) return false;
    std::memcpy(static_cast<void*>(&value), bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return true;
  }

  /// As many as `values` has.
  template <typename T>
  [[nodiscard]] bool take(std::vector<T>& values) {
    static_assert(std::is_standard_layout_v<T>);
    const std::size_t size = values.size() * sizeof(T);
    if (bytes_.size() < size) return false;
    if (size > 0) std::memcpy(static_cast<void*>(values.data()), bytes_.data(), size);
    bytes_.remove_prefix(size);
    return true;
  }

  /// The next `size` bytes; where there are fewer, nothing.
  [[nodiscard]] std::optional<std::string_view> cut(std::size_t size) {
    if (bytes_.size() < size) return std::nullopt;
    const std::string_view front = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return front;
  }

  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
};

}  // namespace rnmbake
