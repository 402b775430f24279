// jobs/upkeep.h - keeps a store small and whole: trims what was not used for longest, verifies what is there.
#pragma once

#include "jobs/store_folder.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

struct TrimGoal {
  std::optional<std::int64_t> bytes;       // that may stay
  std::optional<std::int64_t> older_than;  // nanoseconds since 1970; what was last used before goes
};

struct TrimCounts {
  std::size_t removed = 0, kept = 0;
  std::int64_t bytes_removed = 0, bytes_kept = 0;
  std::size_t refused = 0;  // of those kept: could not be removed
};

/// Least recently used first. Other processes may trim at the same time.
TrimCounts trim_results(StoreContents contents, const TrimGoal& goal);

/// A store's whole folder, with the temporary files that killed processes left. Throws Error(usage) where it
/// is no store of ours.
TrimCounts trim_store(const std::filesystem::path& folder, const TrimGoal& goal);

struct VerifyCounts {
  std::size_t whole = 0, damaged = 0;
  std::int64_t bytes = 0;               // of the whole ones
  std::vector<std::string> unreadable;  // files and folders, each with the reason
};

/// Reads every entry; damaged ones are named in a warning each and removed. Throws Error(usage) as above.
VerifyCounts verify_store(const std::filesystem::path& folder);

}  // namespace rnmbake
