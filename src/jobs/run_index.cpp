#include "jobs/run_index.h"

#include "base/files.h"
#include "base/hash.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include <unistd.h>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX leaves it to us

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_commands = 4096;  // remembered; then all are forgotten

/// Flags of which the whole program has to know.
constexpr std::array<std::string_view, 13> asks_for_more{
    "--why",  "--dry-run", "--force",        "--json",    "--log-format", "--depfile", "-h",
    "--help", "--prune",   "--print-config", "--version", "--time",       "-v"};

bool is_one_of(std::string_view word, const auto& flags) {
  return std::ranges::find(flags, word.substr(0, word.find('='))) != flags.end();
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): before any thread
  return value != nullptr ? value : "";
}

/// "" where nothing is to be remembered.
fs::path folder() {
  if (variable("RNMBAKE_CACHE") == "none") return {};
  if (const std::string cache = variable("XDG_CACHE_HOME"); !cache.empty())
    return fs::path(cache) / "rnmbake-runs";
  const std::string home = variable("HOME");
  return home.empty() ? fs::path() : fs::path(home) / ".cache/rnmbake-runs";
}

fs::path file_of(const std::string& command) {
  const fs::path in = folder();
  return in.empty() ? in : in / hash128_hex(command);
}

/// Settings come from RNMBAKE_*, Blender from PATH, the cache from the rest.
bool decides_settings(std::string_view entry) {
  return entry.starts_with("RNMBAKE_") || entry.starts_with("PATH=") || entry.starts_with("HOME=") ||
         entry.starts_with("XDG_CACHE_HOME=");
}

/// This process's words, as it was started.
std::vector<std::string> own_words() {
  std::vector<std::string> words;
  std::ifstream in("/proc/self/cmdline", std::ios::binary);  // its size is said to be 0
  const std::string all(std::istreambuf_iterator<char>(in), {});
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t end = std::min(all.find('\0', at), all.size());
    words.push_back(all.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

}  // namespace

std::optional<std::string> command_text(std::span<const char* const> words) {
  std::string text;
  for (const char* word : words.subspan(std::min<std::size_t>(1, words.size()))) {
    if (is_one_of(word, asks_for_more)) return std::nullopt;
    text += std::string(word) + '\0';
  }
  std::vector<std::string> variables;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (decides_settings(*entry)) variables.emplace_back(*entry);
  }
  std::ranges::sort(variables);
  for (const std::string& one : variables) text += one + '\0';
  return text + fs::current_path().string();
}

void remember_run(const std::vector<fs::path>& records) {
  try {
    const std::vector<std::string> own = own_words();
    std::vector<const char*> words;
    for (const std::string& word : own) words.push_back(word.c_str());
    const auto command = command_text(words);
    const fs::path file = command ? file_of(*command) : fs::path();
    if (file.empty()) return;
    make_folders(file.parent_path());
    const auto entries = std::distance(fs::directory_iterator(file.parent_path()), {});
    if (static_cast<std::size_t>(entries) > most_commands) {
      fs::remove_all(file.parent_path());
      make_folders(file.parent_path());
    }
    std::string lines;
    for (const fs::path& path : records) {
      const auto record = read_record(path);
      if (!record) return;
      lines += hash128_hex(record->settings) + ' ' + fs::absolute(path).string() + '\n';
    }
    write_atomically(file, lines);
  } catch (const std::exception&) {
    return;  // the next run looks for itself
  }
}

std::optional<UnchangedRun> unchanged_run(std::span<const char* const> words) noexcept {
  try {
    const auto command = command_text(words);
    const fs::path file = command ? file_of(*command) : fs::path();
    if (file.empty() || !fs::exists(file)) return std::nullopt;
    UnchangedRun run;
    std::istringstream lines(read_text(file));
    for (std::string settings, path; lines >> settings && lines.get() && std::getline(lines, path);) {
      auto record = read_record(path);
      const bool is_ours = record && hash128_hex(record->settings) == settings;  // else another command's
      if (!is_ours || !reasons_to_run(*record, record->settings).empty()) return std::nullopt;
      run.records.emplace_back(path);
    }
    return run.records.empty() ? std::nullopt : std::optional(std::move(run));
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace rnmbake
