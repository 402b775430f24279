// scene/blob.h - the binary part beside a JSON part: numbers and arrays cut out of both, every one checked.
#pragma once

#include "base/error.h"
#include "base/json.h"

#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace rnmbake {

/// Says whose an array is, for messages: "object 'Wall': ".
using Owner = std::function<std::string()>;

/// A number that counts or points: an integer, not negative. `key` goes into the message.
[[nodiscard]] inline std::size_t count_of(const nlohmann::json& value, const char* key) {
  if (value.is_number_unsigned()) return value.get<std::size_t>();
  if (!value.is_number_integer() || value.get<std::int64_t>() < 0)
    fail(ExitCode::invalid_input, "'{}' is {}, which is no count", key, brief(value));
  return static_cast<std::size_t>(value.get<std::int64_t>());
}

/// Throws nlohmann's exception where there is no such key, like at() does.
[[nodiscard]] inline std::size_t count_at(const nlohmann::json& entry, const char* key) {
  return count_of(entry.at(key), key);
}

/// An index; -1 stands for none. Too large ones become the largest, which is in no list.
[[nodiscard]] inline int index_of(const nlohmann::json& value, const char* key) {
  if (value.is_number_integer() && !value.is_number_unsigned() && value.get<std::int64_t>() == -1) return -1;
  constexpr std::size_t most = std::numeric_limits<int>::max();
  return static_cast<int>(std::min(count_of(value, key), most));
}

[[nodiscard]] inline int index_at(const nlohmann::json& entry, const char* key) {
  return index_of(entry.at(key), key);
}

/// Cuts typed arrays out of bytes. Arrays do not share bytes, so all of them together are never larger.
class Blob {
 public:
  Blob(const char* bytes, std::size_t size) : bytes_(bytes), size_(size), left_(size) {}

  /// `count` elements at the offset that entry[key] names.
  template <typename T>
  std::vector<T> cut(const nlohmann::json& entry, const char* key, std::size_t count, const Owner& owner) {
    static_assert(std::is_standard_layout_v<T>);
    const std::size_t offset = count_at(entry, key);
    if (offset > size_ || count > (size_ - offset) / sizeof(T) || count > left_ / sizeof(T)) {
      fail(ExitCode::invalid_input, "{}the data ends within {}; was the disk full when it was written?",
           owner(), key);
    }
    left_ -= count * sizeof(T);
    std::vector<T> values(count);
    if (count != 0) std::memcpy(static_cast<void*>(values.data()), bytes_ + offset, count * sizeof(T));
    return values;
  }

 private:
  const char* bytes_;
  std::size_t size_, left_;
};

}  // namespace rnmbake
