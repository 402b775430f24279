// jobs/store_folder.h - what lies in a store's folder, and whether it is one at all.
#pragma once

#include "jobs/key.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

/// By the CACHEDIR.TAG (bford.info/cachedir) with our line in it.
enum class StoreFolder {
  absent,  // there is no such folder, or nothing in it
  ours,
  other,    // of another version of the store's format
  foreign,  // something else is in there
};

/// Throws Error(io) where the folder cannot be read.
[[nodiscard]] StoreFolder look_at_store_folder(const std::filesystem::path& folder);

/// Makes the folder and its CACHEDIR.TAG; backup programs and the like pass over it from then on. Error(io).
void make_store_folder(const std::filesystem::path& folder);

/// Throws Error(usage) for all but `ours` and `absent`, so that nobody trims his pictures.
void require_store_folder(const std::filesystem::path& folder);

/// FOLDER/KIND/DD/DDDD....
[[nodiscard]] std::filesystem::path entry_path(const std::filesystem::path& folder, const ResultKey& key);

struct StoredResult {
  ResultKey key;
  std::filesystem::path file;
  std::int64_t bytes = 0;
  std::int64_t used = 0;  // nanoseconds since 1970
};

struct StoreContents {
  std::vector<StoredResult> results;  // ordered by key
  std::int64_t bytes = 0;
  std::vector<std::filesystem::path> temporary;  // of processes that write now, or were killed
  std::size_t others = 0;                        // files that are not the store's and are left alone
  std::vector<std::string> unreadable;           // folders, each with the reason
};

/// Everything in the folder; what disappears meanwhile is left out.
[[nodiscard]] StoreContents list_store(const std::filesystem::path& folder);

}  // namespace rnmbake
