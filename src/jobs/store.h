// jobs/store.h - results of work, kept in a folder under the hash of what they were made from.
#pragma once

#include "jobs/key.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace rnmbake {

/// A folder of results that several processes, checkouts and machines may share. Thread-safe. A result
/// appears whole or not at all and is checked when it is read: one that is cut off or flipped is named in a
/// warning, removed, and as if it had never been there. A disk that is full costs a warning and what could
/// not be kept, nothing else.
class Store {
 public:
  /// A folder, made at the first put(); "" keeps nothing. `limit`: bytes, 0: none; put() keeps to it by
  /// removing what was not used for longest.
  Store(std::filesystem::path folder, std::int64_t limit);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  /// The result, marked as used now; none if it is not there or not whole.
  [[nodiscard]] std::optional<std::string> get(const ResultKey& key);

  /// Whether get() would find a file; its content is not looked at.
  [[nodiscard]] bool has(const ResultKey& key) const;

  /// Keeps a result: temporary file, fsync, rename. The first of two equal keys stays.
  void put(const ResultKey& key, std::string_view bytes);

  void remove(const ResultKey& key);

 private:
  [[nodiscard]] std::filesystem::path file_of(const ResultKey& key) const;

  std::filesystem::path folder_;
  std::int64_t limit_;
};

}  // namespace rnmbake
