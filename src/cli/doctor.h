// cli/doctor.h - the command `rnmbake doctor`: the machine's Blender, resources, missing parts and their
// remedies.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace rnmbake {

struct DoctorOptions {
  std::optional<std::string> blender;            // --blender
  std::optional<std::filesystem::path> scripts;  // --scripts
  bool json = false;
};

/// Writes the findings to `out`, as a table or as one JSON object. Returns ExitCode::ok, or
/// ExitCode::environment if there is no usable Blender (that is a finding, too, not an exception).
int doctor(const DoctorOptions& options, std::ostream& out);

/// Adds the subcommand to `app`; the returned function runs it with the options that were parsed.
[[nodiscard]] std::function<int()> add_doctor_command(CLI::App& app);

}  // namespace rnmbake
