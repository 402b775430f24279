#include "blender/probe.h"

#include "base/error.h"
#include "base/files.h"
#include "base/text.h"
#include "blender/private_environment.h"
#include "process/run.h"
#include "process/stop.h"

#include <cstdio>
#include <sstream>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

namespace {

constexpr std::size_t longest_reason = 300;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Printed as `blender --version` prints it; leaves at once, since taking the module down may crash.
constexpr const char* module_version = R"(
import os, sys
import bpy
print("\nBlender", bpy.app.version_string)
for name in ("date", "hash", "platform"):
    print("build " + name + ":", getattr(bpy.app, "build_" + name).decode(errors="replace"))
for folder in (sys.prefix, sys.base_prefix, os.path.dirname(bpy.utils.resource_path("LOCAL"))):
    print("folder: " + folder)
sys.stdout.flush()
os._exit(0)
)";

/// Answer of a program that is asked what it is. Error(environment) where it takes too long.
ProcessResult ask(std::vector<std::string> argv, double limit_seconds) {
  const TempFolder home;  // Blender must not look into the user's
  ProcessOptions options;
  options.argv = std::move(argv);
  options.environment = private_environment(home.path());
  options.total_seconds = limit_seconds;
  ProcessResult result = run_process(options);
  if (result.ended_by == ProcessResult::EndedBy::stop_request) {
    throw Error(static_cast<ExitCode>(128 + StopRequest::signal()), "stopped");
  }
  if (result.ended_by != ProcessResult::EndedBy::itself) {
    const bool is_python = options.argv.at(1) == "-c";
    fail(ExitCode::environment, "{} did not answer {} within {:.0f} s; name another Blender with --blender",
         options.argv.front(), is_python ? "`import bpy`" : "--version", limit_seconds);
  }
  return result;
}

std::string how_it_ended(const ProcessResult& result) {
  return result.signal != 0 ? signal_name(result.signal) : fmt::format("exit code {}", result.exit_code);
}

bool is_python(const ProcessResult& answer) {
  int major = 0, minor = 0;
  return answer.succeeded() && std::sscanf(answer.output.c_str(), "Python %d.%d", &major, &minor) == 2;
}

std::string last_words_of(const std::string& output) {
  std::istringstream lines(output);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (line = trimmed(line); !line.empty()) last = line;
  return shortened(last, longest_reason);
}

void probe_module(BlenderInfo& info, double limit_seconds) {
  const std::string name = info.executable.string();
  const ProcessResult answer = ask({name, "-c", module_version}, limit_seconds);
  if (!answer.succeeded() || !parse_version(answer.output, info)) {
    if (answer.output.find("No module named 'bpy'") != std::string::npos) {
      fail(ExitCode::environment,
           "{} is a Python without the module bpy (packages in the home folder do not count); get it by {} "
           "-m pip "
           "install bpy, or name a Blender with --blender",
           name, name);
    }
    fail(ExitCode::environment,
         "{} is a Python that cannot import bpy ({}: {}); mend that, or name a Blender with --blender", name,
         how_it_ended(answer), last_words_of(answer.output));
  }
  info.is_module = true;
  std::istringstream lines(answer.output);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("folder: ", 0) == 0) info.folders.emplace_back(line.substr(8));
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

BlenderInfo probe_version(const std::filesystem::path& executable, double limit_seconds) {
  BlenderInfo info;
  info.executable = executable;
  const std::string name = executable.string();
  const ProcessResult answer = ask({name, "--version"}, limit_seconds);
  if (is_python(answer)) {
    probe_module(info, limit_seconds);
  } else if (!parse_version(answer.output, info)) {
    fail(ExitCode::environment,
         "{} does not say which Blender it is (--version ended with {}); name a Blender with --blender", name,
         how_it_ended(answer));
  }
  if (info.version < oldest_blender) {
    fail(ExitCode::environment,
         "{} is Blender {}, rnmbake needs {}.{} or newer; install one and name it with --blender", name,
         info.version_text, oldest_blender.major, oldest_blender.minor);
  }
  return info;
}

}  // namespace rnmbake
