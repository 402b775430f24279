// jobs/store.h - results of work, kept in a folder under the hash of what they were made from.
#pragma once

#include "jobs/key.h"
#include "jobs/size_estimate.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace rnmbake {

/// A folder of results that several processes, checkouts and machines may share. Thread-safe. A result
/// appears whole or not at all and is checked when it is read: one that is cut off or flipped is named in a
/// warning, removed, and as if it had never been there. A disk that is full costs a warning and what could
/// not be kept, nothing else. No locks: a name that appears by rename is all that processes agree on.
class Store {
 public:
  /// A folder, made at the first put(); "" keeps nothing. `limit`: bytes, 0: none; put() keeps to it by
  /// removing what was not used for longest, down to 90 % of it.
  Store(std::filesystem::path folder, std::int64_t limit);
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  /// Whether put() may keep anything; false for the folder "", and once the disk was full.
  [[nodiscard]] bool keeps() const { return !folder_.empty() && !given_up_; }

  /// The result, marked as used now (to the hour); none if it is not there or not whole.
  [[nodiscard]] std::optional<std::string> get(const ResultKey& key);

  /// Whether get() would find a file; its content is not looked at.
  [[nodiscard]] bool has(const ResultKey& key) const;

  /// Keeps a result: temporary file, fsync, rename. The first of two equal keys stays.
  void put(const ResultKey& key, std::string_view bytes);

  void remove(const ResultKey& key);

 private:
  [[nodiscard]] std::filesystem::path file_of(const ResultKey& key) const;
  void keep(const ResultKey& key, std::string_view bytes);
  [[nodiscard]] bool prepare_folder();
  void make_room(std::int64_t bytes);

  std::filesystem::path folder_;
  std::int64_t limit_;
  std::atomic<bool> given_up_ = false;
  std::mutex mutex_;  // of all below
  SizeEstimate size_;
};

}  // namespace rnmbake
