#include "jobs/upkeep.h"

#include "base/leftovers.h"
#include "base/log.h"
#include "jobs/entry.h"
#include "jobs/size_estimate.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <set>
#include <tuple>

#include <unistd.h>

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

std::int64_t nanoseconds_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// Those whose process is known to have ended, and those that nobody has written to for a day: of their
/// processes, on other machines, nothing can be known.
void sweep_temporary(const StoreContents& contents) {
  constexpr std::int64_t day = std::int64_t{86'400} * 1'000'000'000;
  std::set<fs::path> folders;
  for (const fs::path& file : contents.temporary) folders.insert(file.parent_path());
  for (const fs::path& folder : folders) sweep_leftovers(folder);
  for (const fs::path& file : contents.temporary) {
    const auto state = file_state(file);
    if (state && nanoseconds_now() - state->modified > day) ::unlink(file.c_str());
  }
}

}  // namespace

TrimCounts trim_results(StoreContents contents, const TrimGoal& goal) {
  std::sort(contents.results.begin(), contents.results.end(),
            [](const StoredResult& a, const StoredResult& b) {
              return std::tie(a.used, a.key) < std::tie(b.used, b.key);
            });
  TrimCounts counts;
  counts.kept = contents.results.size();
  counts.bytes_kept = contents.bytes;
  for (const StoredResult& result : contents.results) {
    const bool is_old = goal.older_than && result.used < *goal.older_than;
    const bool is_too_much = goal.bytes && counts.bytes_kept > *goal.bytes;
    if (!is_old && !is_too_much) break;
    if (::unlink(result.file.c_str()) != 0 && errno != ENOENT && errno != ESTALE) {
      ++counts.refused;
      continue;
    }
    ++counts.removed;
    --counts.kept;
    counts.bytes_removed += result.bytes;
    counts.bytes_kept -= result.bytes;
  }
  return counts;
}

TrimCounts trim_store(const fs::path& folder, const TrimGoal& goal) {
  require_store_folder(folder);
  StoreContents contents = list_store(folder);
  sweep_temporary(contents);
  const TrimCounts counts = trim_results(std::move(contents), goal);
  if (look_at_store_folder(folder) == StoreFolder::ours) SizeEstimate(folder, 0).set(counts.bytes_kept);
  return counts;
}

VerifyCounts verify_store(const fs::path& folder) {
  require_store_folder(folder);
  StoreContents contents = list_store(folder);
  sweep_temporary(contents);
  VerifyCounts counts;
  counts.unreadable = std::move(contents.unreadable);
  for (const StoredResult& result : contents.results) {
    const EntryRead read = read_entry(result.file, result.key);
    if (read.is_absent()) continue;
    if (read.payload) {
      ++counts.whole;
      counts.bytes += result.bytes;
    } else if (!read.unreadable.empty()) {
      counts.unreadable.push_back(result.file.string() + ": " + read.unreadable);
    } else {
      ++counts.damaged;
      log::warn("{}: {}; it is removed and made again when it is needed", result.file.string(), read.damage);
      remove_entry(result.file, read.state);
    }
  }
  return counts;
}

}  // namespace rnmbake
