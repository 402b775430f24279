#include "cli/doctor.h"

#include "base/error.h"
#include "base/files.h"
#include "base/machine.h"
#include "base/text.h"
#include "base/version.h"
#include "blender/find.h"
#include "blender/probe.h"
#include "blender/real_blender.h"
#include "blender/sandbox/sandbox.h"
#include "blender/scripts.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {

namespace {

namespace fs = std::filesystem;

struct Missing {
  std::string what, remedy;
};

struct Machine {
  unsigned threads = 0;
  std::uintmax_t memory_bytes = 0, memory_limit_bytes = 0;  // limit 0: none
  fs::path temp_folder;
  std::uintmax_t temp_free_bytes = 0;
};

struct Findings {
  std::optional<BlenderInfo> blender;
  std::optional<std::string> no_sandbox;  // why there is none
  Machine machine;
  std::vector<Missing> missing;
};

Machine probe_machine() {
  Machine machine;
  machine.threads = std::thread::hardware_concurrency();
  machine.memory_bytes = machine_memory();
  machine.memory_limit_bytes = memory_limit();
  machine.temp_folder = temp_root();
  std::error_code error;
  const fs::space_info space = fs::space(machine.temp_folder, error);
  machine.temp_free_bytes = error ? 0 : space.available;
  return machine;
}

void check_blender(const DoctorOptions& options, Findings& findings) {
  try {
    BlenderInfo info = probe_version(find_blender(options.blender));
    probe_devices(info, ScriptFolder(options.scripts));
    findings.blender = std::move(info);
  } catch (const Error& error) {
    if (error.code() != ExitCode::environment) throw;
    findings.missing.push_back(
        {"a usable Blender: " + std::string(error.what()), "Debian, Ubuntu: apt install blender"});
  }
}

void find_missing(Findings& findings) {
  constexpr std::uintmax_t little_space = std::uintmax_t{1} << 30;
  if (findings.blender && !findings.blender->has_numpy) {
    findings.missing.push_back(
        {"numpy in Blender's Python (.glb and .gltf scenes need it)",
         "Debian, Ubuntu: apt install python3-numpy; others: use blender.org's release"});
  }
  if (findings.machine.temp_free_bytes < little_space) {
    findings.missing.push_back({"space for temporary files in " + findings.machine.temp_folder.string(),
                                "free some, or point TMPDIR to a larger disk"});
  }
}

nlohmann::json as_json(const Findings& findings) {
  nlohmann::json json;
  json["schema_version"] = 1;
  json["usable"] = findings.blender.has_value();
  json["rnmbake"] = version;
  json["openimageio"] = RNMBAKE_OPENIMAGEIO_VERSION;
  json["blender"] = nullptr;
  if (const auto& blender = findings.blender) {
    json["blender"] = {{"path", blender->executable.string()}, {"module", blender->is_module},
                       {"version", blender->version_text},     {"build", blender->build},
                       {"devices", blender->devices},          {"numpy", blender->has_numpy},
                       {"denoiser", blender->has_denoiser}};
  }
  json["sandbox"] = {{"usable", !findings.no_sandbox}, {"why_not", findings.no_sandbox.value_or("")}};
  const Machine& machine = findings.machine;
  json["threads"] = machine.threads;
  json["memory_bytes"] = machine.memory_bytes;
  json["memory_limit_bytes"] =
      machine.memory_limit_bytes == 0 ? nlohmann::json() : nlohmann::json(machine.memory_limit_bytes);
  json["temp_folder"] = {{"path", machine.temp_folder.string()}, {"free_bytes", machine.temp_free_bytes}};
  json["missing"] = nlohmann::json::array();
  for (const Missing& missing : findings.missing)
    json["missing"].push_back({{"what", missing.what}, {"remedy", missing.remedy}});
  return json;
}

std::string gibibytes(std::uintmax_t bytes) {
  return fmt::format("{:.1f} GiB", static_cast<double>(bytes) / static_cast<double>(std::uintmax_t{1} << 30));
}

void write_table(const Findings& findings, std::ostream& out) {
  const auto line = [&](const char* name, const std::string& value) {
    out << printable(fmt::format("{:<14}{}", name, value)) << '\n';
  };
  line("rnmbake", version);
  if (const auto& blender = findings.blender) {
    line("Blender",
         fmt::format("{} ({}{})", blender->version_text, blender->is_module ? "Python's module bpy of " : "",
                     blender->executable.string()));
    if (!blender->build.empty()) line("  build", blender->build);
    line("  devices", fmt::format("{}", fmt::join(blender->devices, ", ")));
    line("  numpy", blender->has_numpy ? "yes" : "no");
    line("  denoiser", blender->has_denoiser ? "yes (not used for bakes)" : "no (not needed)");
  } else {
    line("Blender", "none that can be used");
  }
  line("sandbox", findings.no_sandbox ? "no (only --sandbox needs it): " + *findings.no_sandbox : "yes");
  const Machine& machine = findings.machine;
  line("OpenImageIO", RNMBAKE_OPENIMAGEIO_VERSION);
  line("threads", std::to_string(machine.threads));
  const std::string limit = machine.memory_limit_bytes == 0
                                ? ""
                                : fmt::format(", limited to {}", gibibytes(machine.memory_limit_bytes));
  line("memory", gibibytes(machine.memory_bytes) + limit);
  line("temp folder",
       fmt::format("{}, {} free", machine.temp_folder.string(), gibibytes(machine.temp_free_bytes)));
  for (const Missing& missing : findings.missing)
    out << fmt::format("\nmissing: {}\n    get: {}\n", missing.what, missing.remedy);
  if (findings.missing.empty()) out << "\nnothing is missing\n";
}

}  // namespace

int doctor(const DoctorOptions& options, std::ostream& out) {
  Findings findings;
  findings.machine = probe_machine();
  check_blender(options, findings);
  findings.no_sandbox = sandbox_obstacle();
  find_missing(findings);
  if (options.json) {
    // A path need not be UTF-8; JSON must.
    out << as_json(findings).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  } else {
    write_table(findings, out);
  }
  return static_cast<int>(findings.blender ? ExitCode::ok : ExitCode::environment);
}

std::function<int()> add_doctor_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("doctor", "What was found on this machine, what is missing, how to get it");
  const auto options = std::make_shared<DoctorOptions>();
  command
      ->add_option("--blender", options->blender,
                   "Blender to look at, else RNMBAKE_BLENDER, PATH, usual places")
      ->type_name("PATH");
  command
      ->add_option("--scripts", options->scripts,
                   "run the Blender scripts of this folder, not the built-in ones")
      ->type_name("DIR");
  command->add_flag("--json", options->json, "one JSON object instead of the table");
  return [options] { return doctor(*options, std::cout); };
}

}  // namespace rnmbake
