#include "blender/probe.h"

#include "base/error.h"
#include "base/files.h"
#include "blender/private_environment.h"
#include "process/run.h"
#include "process/stop.h"

#include <cstdio>
#include <sstream>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

namespace {

constexpr double probe_limit_seconds = 60;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

bool parse_version(std::string_view output, BlenderInfo& info) {
  std::istringstream lines{std::string(output)};
  bool found = false;
  std::string build;
  for (std::string line; std::getline(lines, line);) {
    BlenderVersion version;
    int used = 0;
    // "Blender 4.2.1 LTS"; two numbers alone are what 2.79 and before print ("Blender 2.79 (sub 0)").
    if (!found && std::sscanf(line.c_str(), "Blender %d.%d%n", &version.major, &version.minor, &used) == 2) {
      std::sscanf(line.c_str() + used, ".%d", &version.patch);
      info.version = version;
      info.version_text = fmt::format("{}.{}.{}", version.major, version.minor, version.patch);
      found = true;
    }
    line = trimmed(line);
    for (const char* key : {"build date:", "build hash:", "build platform:"}) {
      if (line.rfind(key, 0) != 0) continue;
      build += (build.empty() ? "" : ", ") + line.substr(6);
    }
  }
  info.build = build;
  return found;
}

BlenderInfo probe_version(const std::filesystem::path& executable) {
  BlenderInfo info;
  info.executable = executable;
  const std::string name = executable.string();
  const TempFolder home;  // Blender must not look into the user's
  ProcessOptions options;
  options.argv = {name, "--version"};
  options.environment = private_environment(home.path());
  options.total_seconds = probe_limit_seconds;
  const ProcessResult result = run_process(options);
  if (result.ended_by == ProcessResult::EndedBy::stop_request) {
    throw Error(static_cast<ExitCode>(128 + StopRequest::signal()), "stopped");
  }
  if (result.ended_by != ProcessResult::EndedBy::itself) {
    fail(ExitCode::environment,
         "{} did not answer --version within {:.0f} s; name another Blender with --blender", name,
         probe_limit_seconds);
  }
  if (!parse_version(result.output, info)) {
    fail(ExitCode::environment,
         "{} does not say which Blender it is (--version ended with {}); name a Blender with --blender", name,
         result.signal != 0 ? signal_name(result.signal) : fmt::format("exit code {}", result.exit_code));
  }
  if (info.version < oldest_blender) {
    fail(ExitCode::environment,
         "{} is Blender {}, rnmbake needs {}.{} or newer; install one and name it with --blender", name,
         info.version_text, oldest_blender.major, oldest_blender.minor);
  }
  return info;
}

}  // namespace rnmbake
