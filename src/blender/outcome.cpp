#include "blender/outcome.h"

#include "base/disk.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/read_file.h"
#include "base/text.h"
#include "blender/blend_header.h"

#include <algorithm>
#include <array>
#include <sstream>

#include <signal.h>  // NOLINT(modernize-deprecated-headers): SIGKILL

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

using Kind = LaunchFailure::Kind;
using EndedBy = ProcessResult::EndedBy;

constexpr std::size_t details_bytes = 4000;
constexpr std::size_t longest_text = 20000;
constexpr std::uintmax_t largest_answer = std::uintmax_t{64} << 20;

/// The signal, also where a wrapper script turned it into 128 + signal.
int signal_of(const ProcessResult& process) {
  if (process.signal != 0) return process.signal;
  const int hidden = process.exit_code - 128;
  static constexpr std::array fatal = {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGKILL, SIGTRAP, SIGSYS};
  return std::find(fatal.begin(), fatal.end(), hidden) != fatal.end() ? hidden : 0;
}

/// The answer of this very launch; null if there is none.
nlohmann::json answer_in(const fs::path& folder, const std::string& nonce) {
  std::error_code error;
  if (!fs::is_regular_file(folder / "result.json", error)) return nullptr;
  nlohmann::json answer = json_or_null(read_text(folder / "result.json", largest_answer));
  const bool ours = answer.is_object() && answer.contains("nonce") && answer["nonce"] == nonce;
  return ours ? answer : nlohmann::json();
}

/// An exit code of ours, whatever the script says: never the one that means success.
int refusal_code(const nlohmann::json& refusal) {
  const auto code = refusal.find("code");
  const int usual = static_cast<int>(ExitCode::invalid_input);
  if (code == refusal.end() || !code->is_number_unsigned()) return usual;
  const auto value = code->get<std::uint64_t>();
  return value > 0 && value <= static_cast<std::uint64_t>(ExitCode::lock_held) ? static_cast<int>(value)
                                                                               : usual;
}

/// Blender's last words, and the crash report that it leaves in its temporary folder.
std::string last_words(const fs::path& folder) {
  std::string words = read_tail(folder / "stdout.log", details_bytes);
  std::error_code error;
  for (fs::directory_iterator it(folder / "tmp", error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (name.find("crash") != std::string::npos) words += read_tail(it->path(), details_bytes);
  }
  return words;
}

/// The line in which Blender says that it cannot open the scene; empty if there is none.
std::string load_error(const std::string& words) {
  std::istringstream lines(words);
  for (std::string line; std::getline(lines, line);) {
    for (const char* sign :
         {"File format is not supported", "Failed to read blend file", "Cannot read file"}) {
      const std::size_t at = line.find(sign);
      if (at != std::string::npos) return line.substr(at);
    }
  }
  return "";
}

LaunchFailure failure(Kind kind, int code, std::string message, std::string details = "") {
  LaunchFailure out;
  out.kind = kind;
  out.code = code;
  out.message = std::move(message);
  out.details = std::move(details);
  return out;
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string text_at(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  const auto* text = found == object.end() ? nullptr : found->get_ptr<const std::string*>();
  return text == nullptr ? "" : shortened(*text, longest_text);
}

LaunchFailure refused(const nlohmann::json& refusal) {
  LaunchFailure out = failure(Kind::refused, refusal_code(refusal), one_line(text_at(refusal, "message")));
  out.object = text_at(refusal, "object");
  return out;
}

LaunchFailure ended_by_us(const ProcessResult& process, const LaunchLimits& limits, const std::string& words,
                          const ProgressEvent& last) {
  if (process.ended_by == EndedBy::stop_request) return failure(Kind::stopped, 0, "stopped by the user");
  if (process.ended_by == EndedBy::total_limit) {
    return failure(Kind::outlasted, 0,
                   fmt::format("Blender ran longer than the limit of {:.0f} s and was ended, at {}",
                               limits.total_seconds, in_words(last)),
                   words);
  }
  if (process.ended_by == EndedBy::memory_limit) {
    return failure(
        Kind::killed, 0,
        fmt::format("Blender used more than {} MiB and was ended, at {}; raise --memory-max, or try "
                    "a smaller --atlas-limit",
                    limits.memory_bytes >> 20, in_words(last)),
        words);
  }
  if (process.ended_by == EndedBy::output_limit) {
    return failure(Kind::hung, 0,
                   fmt::format("Blender printed more than {} MiB and was ended, at {}",
                               most_output_bytes >> 20, in_words(last)),
                   words);
  }
  return failure(Kind::hung, 0,
                 fmt::format("Blender made no progress for {:.0f} s and was ended, at {}",
                             limits.stall_seconds, in_words(last)),
                 words);
}

LaunchFailure full_disk(const Launch& launch, const std::string& words) {
  return failure(
      Kind::refused, static_cast<int>(ExitCode::io),
      fmt::format("the disk of {} is full; free some space, or point TMPDIR to a folder on another "
                  "disk",
                  launch.folder.string()),
      words);
}

LaunchFailure ended_by_signal(int signal, const std::string& words) {
  if (signal == SIGKILL) {
    return failure(
        Kind::killed, signal,
        "Blender was killed, most likely because memory ran out; try fewer --jobs or a smaller --atlas-limit",
        words);
  }
  if (signal == SIGXFSZ) {
    return failure(Kind::refused, static_cast<int>(ExitCode::io),
                   "Blender wrote a file longer than it may (SIGXFSZ); raise the limit (ulimit -f)", words);
  }
  return failure(Kind::crashed, signal, fmt::format("Blender crashed ({})", signal_name(signal)), words);
}

/// Library that Blender's last line names as being read; else the scene.
fs::path file_in_work(const Launch& launch, const std::string& words) {
  static constexpr std::string_view sign = "Read library: ";
  const std::size_t at = words.rfind(sign);
  const std::size_t from = at == std::string::npos ? at : words.find('\'', at);
  const std::size_t to = from == std::string::npos ? from : words.find('\'', from + 1);
  std::error_code error;
  fs::path library = to == std::string::npos ? fs::path() : fs::path(words.substr(from + 1, to - from - 1));
  return fs::is_regular_file(library, error) ? library : launch.scene->path();
}

/// Replaces a crash over a file of a later Blender by a refusal that names the file.
LaunchFailure crash_or_newer_file(const Launch& launch, const BlenderInfo& info, LaunchFailure failed) {
  if (!launch.scene || failed.kind == Kind::killed || failed.kind == Kind::script) return failed;
  for (const fs::path& file : {file_in_work(launch, failed.details), launch.scene->path()}) {
    const std::string newer =
        newer_blend(file, info, fmt::format("which failed over it ({})", failed.message));
    if (!newer.empty())
      return failure(Kind::refused, static_cast<int>(ExitCode::environment), newer, failed.details);
  }
  return failed;
}

LaunchFailure without_answer(const Launch& launch, const ProcessResult& process, const std::string& words) {
  if (words.starts_with("bwrap: ")) {
    return failure(Kind::refused, static_cast<int>(ExitCode::environment),
                   fmt::format("the sandbox cannot be made: {}; rnmbake doctor says more",
                               words.substr(0, words.find('\n'))),
                   words);
  }
  const std::string load = load_error(words);
  if (process.exit_code == 1 && launch.scene && !load.empty()) {
    return failure(Kind::refused, static_cast<int>(ExitCode::invalid_input),
                   fmt::format("{}: Blender cannot open it ({}); open and save it again with this Blender",
                               launch.scene->string(), load),
                   words);
  }
  if (process.exit_code == 86) {
    return failure(Kind::script, process.exit_code,
                   fmt::format("{} failed before it could answer", launch.entry), words);
  }
  return failure(Kind::no_result, process.exit_code,
                 fmt::format("Blender ended with exit code {} and without a result", process.exit_code),
                 words);
}

LaunchOutcome judge_end(const Launch& launch, const BlenderInfo& info, const std::string& nonce,
                        const ProcessResult& process, const std::string& words) {
  if (const int signal = signal_of(process); signal != 0)
    return crash_or_newer_file(launch, info, ended_by_signal(signal, words));
  nlohmann::json answer;
  try {
    answer = answer_in(launch.folder, nonce);
  } catch (const Error& error) {
    return failure(Kind::no_result, process.exit_code, error.what(), words);
  }
  if (answer.is_null()) return crash_or_newer_file(launch, info, without_answer(launch, process, words));
  if (const auto failed = answer.find("failed"); failed != answer.end()) {
    return failure(Kind::script, process.exit_code,
                   fmt::format("{} failed: {}", launch.entry, one_line(text_at(*failed, "message"))),
                   text_at(*failed, "traceback"));
  }
  if (process.exit_code != 0) {
    return failure(Kind::no_result, process.exit_code,
                   fmt::format("Blender answered but ended with exit code {}", process.exit_code), words);
  }
  if (const auto refusal = answer.find("refused"); refusal != answer.end()) return refused(*refusal);
  if (!answer.contains("ok")) return failure(Kind::no_result, 0, "the result file holds no result", words);
  return Finished{std::move(answer["ok"]), process.wall_seconds, process.cpu_seconds, process.peak_bytes};
}

}  // namespace

LaunchOutcome judge(const Launch& launch, const BlenderInfo& info, const LaunchLimits& limits,
                    const std::string& nonce, const ProcessResult& process, const LaunchWatch& watch) {
  const std::string words = last_words(launch.folder);
  LaunchOutcome outcome = process.ended_by == EndedBy::itself
                              ? judge_end(launch, info, nonce, process, words)
                              : LaunchOutcome(ended_by_us(process, limits, words, watch.last()));
  auto* failure = std::get_if<LaunchFailure>(&outcome);
  if (failure != nullptr) failure->phase = watch.last().phase;
  const bool has_reason =
      failure != nullptr && (failure->kind == Kind::stopped || failure->kind == Kind::refused);
  if (has_reason) return outcome;
  // A full disk comes before any other outcome, success included.
  const bool is_full = watch.ran_out_of_room() || (failure != nullptr && disk_is_full(launch.folder));
  return is_full ? full_disk(launch, words) : outcome;
}

}  // namespace rnmbake
