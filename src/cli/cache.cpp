#include "cli/cache.h"

#include "base/error.h"
#include "base/log.h"
#include "base/text.h"
#include "base/text_table.h"
#include "config/resolve.h"
#include "jobs/upkeep.h"
#include "pipeline/run/result_store.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

constexpr const char* cache_examples =
    "Examples:\n"
    "  rnmbake cache stats                    how much is kept, and since when\n"
    "  rnmbake cache trim --older-than 30     without what nobody used for 30 days\n"
    "  rnmbake cache trim --to 0              without anything\n"
    "  rnmbake cache verify --cache /srv/rnm  read all of a shared cache";

struct CacheFlags {
  std::optional<std::filesystem::path> cache;  // --cache
  std::optional<std::int64_t> to;              // MiB
  std::optional<double> older_than;            // days
  bool json = false;
};

/// The folder that is looked after, and its limit.
struct CachePlace {
  std::filesystem::path folder;
  std::int64_t limit = 0;  // bytes; 0: none
};

CachePlace place_of(const CacheFlags& flags) {
  const ResolvedConfig config = resolve({}, read_environment(process_environment()), {});
  const RunSettings& run = config.globals.run;
  CachePlace place{cache_folder(flags.cache.value_or(run.cache)), std::int64_t{run.cache_limit} << 20};
  if (place.folder.empty())
    fail(ExitCode::usage, "there is no cache: it is switched off (none); name its folder with --cache DIR");
  require_store_folder(place.folder);
  return place;
}

std::string bytes_text(std::int64_t bytes) {
  constexpr std::int64_t kib = 1 << 10, mib = 1 << 20, gib = 1 << 30;
  if (bytes >= gib) return fmt::format("{:.1f} GiB", double(bytes) / double(gib));
  if (bytes >= mib) return fmt::format("{:.1f} MiB", double(bytes) / double(mib));
  if (bytes >= kib) return fmt::format("{:.1f} KiB", double(bytes) / double(kib));
  return counted(static_cast<std::size_t>(bytes), "byte");
}

/// "2026-01-31T14:03:10Z".
std::string utc_text(std::int64_t nanoseconds) {
  const std::time_t seconds = nanoseconds / 1'000'000'000;
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  char text[64] = {};
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::int64_t days_ago(double days) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::nanoseconds(now).count() - static_cast<std::int64_t>(days * 86'400e9);
}

struct KindCounts {
  std::size_t results = 0;
  std::int64_t bytes = 0;
};

std::map<std::string, KindCounts> by_kind(const StoreContents& contents) {
  std::map<std::string, KindCounts> kinds;
  for (const StoredResult& result : contents.results) {
    KindCounts& counts = kinds[result.key.kind];
    ++counts.results;
    counts.bytes += result.bytes;
  }
  return kinds;
}

std::optional<std::string> oldest_use(const StoreContents& contents) {
  const auto oldest = std::min_element(contents.results.begin(), contents.results.end(),
                                       [](const auto& a, const auto& b) { return a.used < b.used; });
  if (oldest == contents.results.end()) return std::nullopt;
  return utc_text(oldest->used);
}

nlohmann::json stats_json(const CachePlace& place, const StoreContents& contents) {
  nlohmann::json kinds = nlohmann::json::object();
  for (const auto& [kind, counts] : by_kind(contents))
    kinds[kind] = {{"results", counts.results}, {"bytes", counts.bytes}};
  const auto oldest = oldest_use(contents);
  return {{"schema_version", 1},
          {"folder", valid_utf8(place.folder.string())},
          {"limit_bytes", place.limit > 0 ? nlohmann::json(place.limit) : nlohmann::json()},
          {"results", contents.results.size()},
          {"bytes", contents.bytes},
          {"kinds", kinds},
          {"oldest_use", oldest ? nlohmann::json(*oldest) : nlohmann::json()},
          {"temporary_files", contents.temporary.size()},
          {"other_files", contents.others}};
}

void write_stats(const CachePlace& place, const StoreContents& contents, std::ostream& out) {
  const auto line = [&](const char* name, const std::string& value) {
    out << printable(fmt::format("{:<10}{}", name, value)) << '\n';
  };
  line("folder", place.folder.string());
  line("limit", place.limit > 0 ? bytes_text(place.limit) : "none");
  line("kept", fmt::format("{}, {}", counted(contents.results.size(), "result"), bytes_text(contents.bytes)));
  if (const auto oldest = oldest_use(contents)) line("oldest", "used " + *oldest);
  if (!contents.temporary.empty())
    line("half",
         counted(contents.temporary.size(), "file") + " being written, or left by runs that were killed");
  if (contents.others > 0)
    line("other", counted(contents.others, "file") + " that are not rnmbake's, left alone");
  if (contents.results.empty()) return;
  out << '\n';
  TextTable table;
  table.add({"kind", "results", "size"});
  for (const auto& [kind, counts] : by_kind(contents))
    table.add({kind, std::to_string(counts.results), bytes_text(counts.bytes)});
  table.write(out);
}

/// Exit code for what could not be read.
int say_unreadable(const std::vector<std::string>& unreadable) {
  for (const std::string& one : unreadable) log::error("cannot read {}; give this user access to it", one);
  return static_cast<int>(unreadable.empty() ? ExitCode::ok : ExitCode::io);
}

int cache_stats(const CacheFlags& flags) {
  const CachePlace place = place_of(flags);
  const StoreContents contents = list_store(place.folder);
  if (flags.json) {
    std::cout << stats_json(place, contents).dump(2) << '\n';
  } else {
    write_stats(place, contents, std::cout);
  }
  return say_unreadable(contents.unreadable);
}

int cache_trim(const CacheFlags& flags) {
  const CachePlace place = place_of(flags);
  TrimGoal goal;
  if (flags.to) goal.bytes = *flags.to << 20;
  if (flags.older_than) goal.older_than = days_ago(*flags.older_than);
  if (!flags.to && !flags.older_than && place.limit > 0) goal.bytes = place.limit;
  const TrimCounts counts = trim_store(place.folder, goal);
  if (counts.refused > 0)
    log::warn("{} could not be removed; run this as the user who owns them",
              counted(counts.refused, "result"));
  if (flags.json) {
    const nlohmann::json json{{"schema_version", 1},       {"folder", valid_utf8(place.folder.string())},
                              {"removed", counts.removed}, {"removed_bytes", counts.bytes_removed},
                              {"kept", counts.kept},       {"kept_bytes", counts.bytes_kept},
                              {"refused", counts.refused}};
    std::cout << json.dump(2) << '\n';
  } else {
    std::cout << fmt::format("removed {}, {}; kept {}, {}\n", counted(counts.removed, "result"),
                             bytes_text(counts.bytes_removed), counts.kept, bytes_text(counts.bytes_kept));
  }
  return static_cast<int>(ExitCode::ok);
}

int cache_verify(const CacheFlags& flags) {
  const CachePlace place = place_of(flags);
  const VerifyCounts counts = verify_store(place.folder);
  if (flags.json) {
    nlohmann::json unreadable = nlohmann::json::array();
    for (const std::string& one : counts.unreadable) unreadable.push_back(valid_utf8(one));
    const nlohmann::json json{{"schema_version", 1},       {"folder", valid_utf8(place.folder.string())},
                              {"whole", counts.whole},     {"bytes", counts.bytes},
                              {"damaged", counts.damaged}, {"unreadable", unreadable}};
    std::cout << json.dump(2) << '\n';
  } else {
    std::cout << fmt::format("{} whole, {}; {} damaged and removed\n", counted(counts.whole, "result"),
                             bytes_text(counts.bytes), counts.damaged);
  }
  return say_unreadable(counts.unreadable);
}

CLI::App& add_tool(CLI::App& cache, const char* name, const char* help, CacheFlags& flags) {
  CLI::App* tool = cache.add_subcommand(name, help);
  tool->footer("");
  tool->add_option("--cache", flags.cache,
                   "the cache's folder [RNMBAKE_CACHE, else $XDG_CACHE_HOME/rnmbake, else ~/.cache/rnmbake]")
      ->type_name("DIR");
  tool->add_flag("--json", flags.json, "one JSON object instead of text");
  return *tool;
}

}  // namespace

std::function<int()> add_cache_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("cache", "What is kept of earlier runs: stats, trim, verify");
  const auto flags = std::make_shared<CacheFlags>();
  command->footer(cache_examples);
  command->require_subcommand(0, 1);
  add_tool(*command, "stats", "How much is kept, of which kinds, and when the oldest was used last", *flags);
  CLI::App& trim = add_tool(
      *command, "trim",
      "Remove what was not used for longest, down to the limit (RNMBAKE_CACHE_LIMIT), or as the flags say",
      *flags);
  trim.add_option("--to", flags->to, "down to this size")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 40).description(""))
      ->type_name("MIB");
  trim.add_option("--older-than", flags->older_than, "all that was last used so many days ago or earlier")
      ->check(CLI::Range(0.0, 36'500.0).description(""))
      ->type_name("DAYS");
  add_tool(*command, "verify", "Read every result; name those that are damaged, and remove them", *flags);
  return [flags, command] {
    if (command->got_subcommand("stats")) return cache_stats(*flags);
    if (command->got_subcommand("trim")) return cache_trim(*flags);
    if (command->got_subcommand("verify")) return cache_verify(*flags);
    fail(ExitCode::usage,
         "cache needs to know what to do: stats, trim or verify; see 'rnmbake cache --help'");
  };
}

}  // namespace rnmbake
