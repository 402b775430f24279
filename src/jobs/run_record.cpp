#include "jobs/run_record.h"

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/json.h"
#include "base/read_file.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include <sys/stat.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int record_version = 1;

/// Size and time of a file, without its content.
RunFile glance_at(std::string kind, const fs::path& path) {
  RunFile state{std::move(kind), path, -1, 0, ""};
  struct stat found {};
  if (stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return state;
  state.size = found.st_size;
  state.time = std::int64_t(found.st_mtim.tv_sec) * 1'000'000'000 + found.st_mtim.tv_nsec;
  return state;
}

std::string said(const RunFile& file, const char* what) {
  return fmt::format("{} {} {}", file.kind, file.path.filename().string(), what);
}

/// Lines of `now` that are not in `before`, and the other way round: settings are a line each.
Reasons changed_settings(const std::string& before, const std::string& now) {
  const auto lines = [](const std::string& text) {
    std::vector<std::string> all;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) all.push_back(line);
    std::ranges::sort(all);
    return all;
  };
  const std::vector<std::string> old_lines = lines(before), new_lines = lines(now);
  Reasons reasons;
  for (const std::string& line : new_lines) {
    if (!std::ranges::binary_search(old_lines, line)) reasons.push_back("setting " + line);
  }
  if (reasons.empty() && old_lines != new_lines) reasons.emplace_back("a setting was taken back");
  return reasons;
}

}  // namespace

RunFile look_at(std::string kind, const fs::path& path, const std::string& hash) {
  RunFile state = glance_at(std::move(kind), path);
  if (state.size >= 0) state.hash = hash.empty() ? file_hash128_hex(path) : hash;
  return state;
}

Reasons reasons_to_run(RunRecord& record, const std::string& settings) {
  Reasons reasons = changed_settings(record.settings, settings);
  for (RunFile& before : record.files) {
    const RunFile now = glance_at(before.kind, before.path);
    if (now.size == before.size && now.time == before.time) continue;
    if (now.size < 0) {
      reasons.push_back(said(before, "is gone"));
    } else if (before.size < 0) {
      reasons.push_back(said(before, "is there now"));
    } else if (now.size != before.size || look_at(before.kind, before.path).hash != before.hash) {
      reasons.push_back(said(before, "changed"));
    } else {
      before.time = now.time;
    }
  }
  return reasons;
}

std::optional<RunRecord> read_record(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  try {
    const json text = parse_json(read_text(file), file.string());
    if (text.at("version") != record_version) return std::nullopt;
    RunRecord record{text.at("settings").get<std::string>(), {}};
    for (const json& one : text.at("files")) {
      record.files.push_back({one.at(0).get<std::string>(), one.at(1).get<std::string>(),
                              one.at(2).get<std::int64_t>(), one.at(3).get<std::int64_t>(),
                              one.at(4).get<std::string>()});
    }
    return record;
  } catch (const Error&) {
    return std::nullopt;  // cut off, or not ours: as if it were not there
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

void write_record(const fs::path& file, const RunRecord& record) {
  json files = json::array();
  for (const RunFile& one : record.files)
    files.push_back({one.kind, one.path.string(), one.size, one.time, one.hash});
  const json text{{"version", record_version}, {"settings", record.settings}, {"files", std::move(files)}};
  write_atomically(file, text.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
}

}  // namespace rnmbake
