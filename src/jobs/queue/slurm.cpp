#include "jobs/queue/slurm.h"

#include "base/error.h"
#include "base/text.h"
#include "process/run.h"
#include "process/tree.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string_view>
#include <utility>

#include <unistd.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

constexpr double patience_seconds = 120;  // with a controller that is about to come back

constexpr std::array<std::string_view, 10> ended_states{
    "BOOT_FAIL", "CANCELLED",     "COMPLETED", "DEADLINE", "FAILED",
    "NODE_FAIL", "OUT_OF_MEMORY", "PREEMPTED", "REVOKED",  "TIMEOUT"};

bool is_on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (!folder.empty() && ::access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

/// Without our mark, which sbatch would hand on: a later run on that machine would end the job as one that a
/// killed run left behind.
std::optional<CommandAnswer> run_on_path(const std::vector<std::string>& argv) {
  if (!is_on_path(argv.front())) return std::nullopt;
  ProcessOptions options;
  options.argv = {"env", "-u", launch_variable};
  options.argv.insert(options.argv.end(), argv.begin(), argv.end());
  options.total_seconds = patience_seconds;
  ProcessResult ended = run_process(options);
  if (ended.succeeded()) return CommandAnswer{0, std::move(ended.output)};
  if (ended.ended_by == ProcessResult::EndedBy::total_limit)
    ended.output += fmt::format("no answer in {} s", patience_seconds);
  return CommandAnswer{std::max(1, ended.exit_code), std::move(ended.output)};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

/// Its lines as one, without the program's own name before each.
std::string in_one_line(const std::string& text) {
  std::string words;
  for (std::string line : lines_of(text)) {
    for (const std::string_view prefix : {"sbatch: ", "squeue: ", "scancel: ", "scontrol: ", "error: "}) {
      if (line.starts_with(prefix)) line.erase(0, prefix.size());
    }
    words += (words.empty() ? "" : "; ") + printable(line);
  }
  return words.empty() ? "it says nothing" : words;
}

std::optional<std::size_t> number_of(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Of a line "ID|INDEX|STATE|NODES|REASON".
std::optional<SlurmJob> job_of(const std::string& line) {
  std::istringstream stream(line);
  SlurmJob job;
  std::string index;
  const auto cell = [&](std::string& text) { return bool(std::getline(stream, text, '|')); };
  if (!cell(job.id) || !cell(index) || !cell(job.state) || !cell(job.nodes) || !number_of(job.id))
    return std::nullopt;
  std::getline(stream, job.reason);
  job.index = number_of(index);
  return job;
}

}  // namespace

bool SlurmJob::is_alive() const {
  return std::ranges::find(ended_states, state) == ended_states.end();
}

bool SlurmJob::is_held() const {
  return is_alive() && (state == "REQUEUE_HOLD" || reason.find("Held") != std::string::npos ||
                        reason.find("held") != std::string::npos);
}

Slurm::Slurm() : run_(run_on_path) {}

std::string Slurm::must(const std::vector<std::string>& argv, const std::string& remedy) const {
  const auto answer = run_(argv);
  if (!answer)
    fail(ExitCode::environment,
         "there is no {} on PATH; run this on a machine that Slurm takes jobs from (Debian: slurm-client)",
         argv.front());
  if (answer->exit_code != 0)
    fail(ExitCode::environment, "{} refuses: {}; {}", argv.front(), in_one_line(answer->text), remedy);
  return answer->text;
}

std::size_t Slurm::array_limit() const {
  const std::string text = must({"scontrol", "show", "config"}, "is this a machine of the cluster?");
  for (const std::string& line : lines_of(text)) {
    if (!line.starts_with("MaxArraySize")) continue;
    const std::size_t value = line.find_last_of(" =");
    const auto limit = number_of(std::string_view(line).substr(value + 1));
    if (limit && *limit > 0) return *limit;
  }
  fail(ExitCode::environment,
       "Slurm takes no arrays of jobs here (MaxArraySize is 0); raise it in slurm.conf");
}

std::string Slurm::submit(const std::vector<std::string>& words) const {
  std::vector<std::string> argv{"sbatch", "--parsable"};
  argv.insert(argv.end(), words.begin(), words.end());
  const std::string text = must(argv, "change what it is told with --slurm-arg");
  const std::vector<std::string> lines = lines_of(text);
  // Sites let sbatch say more before it; "ID;CLUSTER" where there are several clusters.
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    const std::string id = line->substr(0, line->find(';'));
    if (number_of(id)) return id;
  }
  fail(ExitCode::environment, "sbatch names no job: {}", in_one_line(text));
}

std::optional<std::vector<SlurmJob>> Slurm::jobs_named(const std::string& name) const {
  const auto answer = run_({"squeue", "-h", "-r", "-t", "all", "--name=" + name, "-o", "%F|%K|%T|%N|%r"});
  if (!answer || answer->exit_code != 0) return std::nullopt;
  std::vector<SlurmJob> jobs;
  for (const std::string& line : lines_of(answer->text)) {
    if (auto job = job_of(line)) jobs.push_back(std::move(*job));
  }
  return jobs;
}

void Slurm::cancel(const std::string& name) const {
  (void)must({"scancel", "--name=" + name}, "try again");
}

}  // namespace rnmbake
