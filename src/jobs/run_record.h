// jobs/run_record.h - what a run read and what it wrote, so that the same run need not be run again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

/// A file as it was. Size and time are looked at first; only where they differ is the content.
struct RunFile {
  std::string kind;  // "scene", "picture", "output", ...: what a message calls it
  std::filesystem::path path;
  std::int64_t size = -1;  // bytes; -1: there was no such file
  std::int64_t time = 0;   // of its last change, nanoseconds
  std::string hash;        // of its content
};

/// The file as it is now. `hash`: of its content, where somebody knows it.
[[nodiscard]] RunFile look_at(std::string kind, const std::filesystem::path& path,
                              const std::string& hash = "");

struct RunRecord {
  std::string settings;  // all that decide what comes out
  std::vector<RunFile> files;
};

/// Why a run has to be run again: one sentence each, most telling first. Empty: it need not be.
using Reasons = std::vector<std::string>;

/// Holds a record against what is there now. Files with another time and the same content count as
/// unchanged; `record` then takes their times over.
[[nodiscard]] Reasons reasons_to_run(RunRecord& record, const std::string& settings);

/// The record of a folder; nothing where there is none that can be read.
[[nodiscard]] std::optional<RunRecord> read_record(const std::filesystem::path& file);

void write_record(const std::filesystem::path& file, const RunRecord& record);

}  // namespace rnmbake
