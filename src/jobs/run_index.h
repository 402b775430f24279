// jobs/run_index.h - finds the record of a command that was run before by its words alone, before anything
// of it is parsed.
#pragma once

#include "jobs/run_record.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rnmbake {

/// What decides a command's settings, but for files: its words without the program's own, the working folder,
/// and variables. Nothing where it asks for more than to be done: reasons, a plan, an answer in JSON.
[[nodiscard]] std::optional<std::string> command_text(std::span<const char* const> words);

/// Remembers where the records of this process's command lie, for this user on this machine: in
/// $XDG_CACHE_HOME/rnmbake-runs. Nothing is remembered with RNMBAKE_CACHE=none, or where that folder cannot
/// be written.
void remember_run(const std::vector<std::filesystem::path>& records);

/// A command that need not be run again.
struct UnchangedRun {
  std::vector<std::filesystem::path> records;
};

/// Whether the command was run before and nothing that it read or wrote is different now. In doubt: no.
[[nodiscard]] std::optional<UnchangedRun> unchanged_run(std::span<const char* const> words) noexcept;

}  // namespace rnmbake
