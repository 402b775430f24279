#include "blender/real_blender.h"

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "blender/blend_header.h"
#include "blender/launch_watch.h"
#include "blender/outcome.h"
#include "blender/private_environment.h"
#include "blender/sandbox/sandbox.h"
#include "process/run.h"
#include "process/tree.h"

#include <cstdlib>
#include <random>

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

constexpr double device_limit_seconds = 120;

constexpr BlenderVersion first_with_offline_mode = {4, 2, 0};  // before, it is taken for a file name
constexpr BlenderVersion first_with_named_levels = {5, 0, 0};  // of what is logged

/// Cycles says how many samples it has taken of a bake, but only when asked to.
std::vector<std::string> let_cycles_speak(const BlenderVersion& version) {
  if (version < first_with_named_levels) return {"--verbose", "3"};
  return {"--log", "cycles.*,render", "--log-level", "debug"};
}

std::string new_nonce() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", device(), device(), device(), device());
}

/// Removes files of an earlier try and writes the request.
void prepare(const Launch& launch, const std::string& nonce) {
  for (const char* name : {"result.json", "progress.jsonl", "stdout.log"}) fs::remove(launch.folder / name);
  make_folders(launch.folder / "tmp");
  make_folders(launch.folder / "home");
  nlohmann::json request = launch.request.is_null() ? nlohmann::json::object() : launch.request;
  request["nonce"] = nonce;
  request["folder"] = fs::absolute(launch.folder).string();
  if (launch.save_as) request["save_as"] = fs::absolute(*launch.save_as).string();
  try {
    write_atomically(launch.folder / "request.json", request.dump());
  } catch (const nlohmann::json::type_error&) {
    fail(ExitCode::unsupported, "a path or name given to {} is not UTF-8; rename it", launch.entry);
  }
}

/// Refusal of a scene that Blender cannot open, found before its start: Blender would crash, or name neither
/// file nor cause.
std::optional<LaunchFailure> unreadable_scene(const Launch& launch, const BlenderInfo& info) {
  if (!launch.scene) return std::nullopt;
  LaunchFailure failure;
  failure.kind = LaunchFailure::Kind::refused;
  try {
    if (!read_blend_header(launch.scene->path())) {
      failure.code = static_cast<int>(ExitCode::invalid_input);
      failure.message = fmt::format("{}: is no .blend file, it does not begin as Blender's files do",
                                    launch.scene->string());
    } else {
      failure.code = static_cast<int>(ExitCode::environment);
      failure.message = unreadable_blend(launch.scene->path(), info);
    }
  } catch (const Error& error) {
    failure.code = static_cast<int>(error.code());
    failure.message = error.what();
  }
  return failure.message.empty() ? std::nullopt : std::optional(failure);
}

/// The folder that takes the place of the one where the script saves its file.
fs::path staging(const Launch& launch) {
  return launch.folder / "saved";
}

Sandbox sandbox_for(const LaunchTrust::Sandboxed& trust, const BlenderInfo& info, const ScriptFolder& scripts,
                    const Launch& launch) {
  Sandbox sandbox;
  sandbox.gpu = trust.gpu;
  sandbox.read = {fs::absolute(info.executable).parent_path()};
  std::error_code error;
  if (const fs::path real = fs::canonical(info.executable, error); !error)
    sandbox.read.push_back(real.parent_path());
  for (const fs::path& folder : sandbox.read) refuse_broad_folder(folder, info.executable.string());
  sandbox.read.push_back(scripts.path());
  sandbox.read.insert(sandbox.read.end(), info.folders.begin(), info.folders.end());
  sandbox.read.insert(sandbox.read.end(), trust.read.begin(), trust.read.end());
  std::vector<fs::path> scenes;
  if (launch.scene) scenes.push_back(launch.scene->path());
  if (launch.request.is_object() && launch.request.contains("scene"))
    scenes.emplace_back(launch.request["scene"].get<std::string>());
  for (const fs::path& scene : scenes) {
    sandbox.read.push_back(fs::absolute(scene).parent_path());
    refuse_broad_folder(sandbox.read.back(), scene.string());
    if (const fs::path real = fs::canonical(scene, error); !error) sandbox.read.push_back(real);
  }
  sandbox.write = launch.folder;
  if (launch.save_as) {
    make_folders(staging(launch));
    sandbox.staged = {*launch.save_as, staging(launch)};
  }
  return sandbox;
}

/// What a sandboxed launch has left, before anybody reads it. The file that it saved goes to its place.
LaunchOutcome checked(LaunchOutcome outcome, const Launch& launch, const std::optional<std::string>& link) {
  if (!std::holds_alternative<Finished>(outcome)) return outcome;
  if (link) {
    LaunchFailure failure;
    failure.kind = LaunchFailure::Kind::refused;
    failure.code = static_cast<int>(ExitCode::invalid_input);
    failure.message = fmt::format(
        "{}: something in it left a link or pipe among the results ({}), which leads out of the sandbox",
        launch.scene ? launch.scene->string() : launch.entry, *link);
    return failure;
  }
  if (launch.save_as) {
    fs::copy_file(staging(launch) / launch.save_as->filename(), *launch.save_as,
                  fs::copy_options::overwrite_existing);
  }
  return outcome;
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

}  // namespace

std::vector<std::string> launch_argv(const BlenderInfo& info, const ScriptFolder& scripts,
                                     const LaunchTrust& trust, const Launch& launch) {
  std::vector<std::string> argv = {info.executable.string()};
  if (info.is_module) argv.push_back(scripts.entry("bpy_runner.py").string());
  argv.insert(argv.end(), {"-b", "--factory-startup", "-noaudio", trust.allow_scripts ? "-y" : "-Y"});
  if (info.version >= first_with_offline_mode) argv.emplace_back("--offline-mode");
  for (std::string& word : let_cycles_speak(info.version)) argv.push_back(std::move(word));
  if (launch.threads > 0) argv.insert(argv.end(), {"-t", std::to_string(launch.threads)});
  argv.insert(argv.end(), {"--python-exit-code", "86"});
  if (launch.scene) {
    if (!trust.allow_scripts) argv.insert(argv.end(), {"--python", scripts.entry("guard.py").string()});
    argv.push_back(launch.scene->string());
  }
  const std::string request = (fs::absolute(launch.folder) / "request.json").string();
  argv.insert(argv.end(), {"--python", scripts.entry(launch.entry).string(), "--", request});
  return argv;
}

/// PATH with Blender's own folder in front. A Blender that a Linux distribution links against its own Python
/// takes the first python3 there for it, and finds that one's packages: of pyenv or conda, without numpy.
std::string path_of(const BlenderInfo& info) {
  const char* path = std::getenv("PATH");
  const std::string own = fs::absolute(info.executable).parent_path().string();
  return path == nullptr ? own : own + ":" + path;
}

LaunchOutcome launch_blender(const BlenderInfo& info, const ScriptFolder& scripts, const LaunchTrust& trust,
                             const Launch& launch, const LaunchLimits& limits,
                             const std::function<void(const ProgressEvent&)>& on_progress) {
  if (auto failure = unreadable_scene(launch, info)) return *failure;
  const std::string nonce = new_nonce();
  prepare(launch, nonce);
  ProcessOptions options;
  options.argv = launch_argv(info, scripts, trust, launch);
  options.environment = private_environment(launch.folder, trust.sandbox ? "" : scripts.bytecode());
  options.environment.emplace_back("PATH", path_of(info));
  if (trust.sandbox) {
    options.argv = sandboxed(options.argv, sandbox_for(*trust.sandbox, info, scripts, launch));
    options.bare = true;
    const auto ours = sandbox_environment(trust.sandbox->gpu);
    options.environment.insert(options.environment.end(), ours.begin(), ours.end());
  }
  if (info.is_module)
    options.environment.emplace_back("GLOG_v", "3");  // as --verbose, which it does not have
  options.output = launch.folder / "stdout.log";
  options.total_seconds = limits.total_seconds;
  options.stall_seconds = limits.stall_seconds;
  options.output_bytes = most_output_bytes;
  options.memory_bytes = limits.memory_bytes;
  log::debug("starting {}", joined(options.argv));
  LaunchWatch watch(launch.folder, on_progress);
  const ProcessResult process = run_process(options, [&](const ProcessStatus&) { return watch.poll(); });
  if (!trust.sandbox) return judge(launch, info, limits, nonce, process, watch);
  const std::optional<std::string> link = remove_links(launch.folder);
  return checked(judge(launch, info, limits, nonce, process, watch), launch, link);
}

RealBlender::RealBlender(BlenderInfo info, const Options& options)
    : info_(std::move(info)), trust_(options.trust), scripts_(options.scripts) {
  if (const int ended = end_leftover_processes(); ended > 0) {
    log::info("{} processes that a run had left when it was killed were ended", ended);
  }
}

const BlenderInfo& RealBlender::complete_info() {
  if (info_.devices.empty()) probe_devices(info_, scripts_);
  return info_;
}

LaunchOutcome RealBlender::run(const Launch& launch, const LaunchLimits& limits,
                               const std::function<void(const ProgressEvent&)>& on_progress) {
  return launch_blender(info_, scripts_, trust_, launch, limits, on_progress);
}

void probe_devices(BlenderInfo& info, const ScriptFolder& scripts) {
  const TempFolder folder;
  Launch launch;
  launch.entry = "probe_entry.py";
  launch.folder = folder.path();
  launch.request = nlohmann::json::object();
  LaunchLimits limits;
  limits.total_seconds = device_limit_seconds;  // looking for GPUs may build kernels
  const LaunchOutcome outcome = launch_blender(info, scripts, {}, launch, limits, {});
  if (const auto* failure = std::get_if<LaunchFailure>(&outcome)) {
    fail(ExitCode::environment, "{} (Blender {}) does not run headless: {}; try another with --blender",
         info.executable.string(), info.version_text, failure->message);
  }
  const nlohmann::json& result = std::get<Finished>(outcome).result;
  info.devices = result.at("devices").get<std::vector<std::string>>();
  info.has_numpy = result.at("numpy").get<bool>();
  info.has_denoiser = result.at("denoiser").get<bool>();
}

}  // namespace rnmbake
