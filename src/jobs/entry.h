// jobs/entry.h - the file of one result: a line of text that names it, then its bytes.
#pragma once

#include "jobs/key.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace rnmbake {

/// "rnmbake-result 1 KIND DIGITS LENGTH HASH\n": version of the format, key, bytes of the payload and their
/// XXH3-128.
[[nodiscard]] std::string entry_header(const ResultKey& key, std::string_view payload);

/// A file as it was when it was looked at, to tell it from one that took its place since.
struct FileState {
  std::uint64_t device = 0, inode = 0;
  std::int64_t bytes = 0;
  std::int64_t modified = 0;  // nanoseconds since 1970; the time of the last use
  bool operator==(const FileState&) const = default;
};

/// Of the name itself, not of what a link leads to; nothing where there is no such file.
[[nodiscard]] std::optional<FileState> file_state(const std::filesystem::path& file);

struct EntryRead {
  std::optional<std::string> payload;
  std::string damage;      // what is wrong with it; "" where nothing is
  std::string unreadable;  // why nobody can tell: no permission, a broken disk
  FileState state;         // of the file that was read

  /// There is no such file, or another process has just removed it.
  [[nodiscard]] bool is_absent() const { return !payload && damage.empty() && unreadable.empty(); }
};

/// Exactly one of payload, damage and unreadable, or none of them.
[[nodiscard]] EntryRead read_entry(const std::filesystem::path& file, const ResultKey& key);

/// Removes a damaged entry unless another one has taken its place meanwhile.
void remove_entry(const std::filesystem::path& file, const FileState& damaged);

}  // namespace rnmbake
