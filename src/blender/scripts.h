// blender/scripts.h - the Python scripts that Blender runs: carried in the binary, unpacked to a private
// folder.
#pragma once

#include "base/files.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

struct EmbeddedScript {
  const char* name;  // below blender_scripts/: "core/task.py"
  const char* text;
};

/// Generated at build time by cmake/EmbedScripts.cmake.
const std::vector<EmbeddedScript>& embedded_scripts();

/// A folder with all scripts for as long as this object lives.
class ScriptFolder {
 public:
  /// `instead`: use this folder as it is (--scripts). Error(usage) if it is none.
  explicit ScriptFolder(const std::optional<std::filesystem::path>& instead = {});

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Where Python keeps what it compiled, for the launches that follow: Debian's Blender comes without, and
  /// compiling its add-ons is half of its start.
  [[nodiscard]] const std::filesystem::path& bytecode() const { return bytecode_.path(); }

  /// The path of an entry script. Error(environment) if there is none of that name.
  [[nodiscard]] std::filesystem::path entry(const std::string& name) const;

 private:
  std::optional<TempFolder> unpacked_;
  TempFolder bytecode_;
  std::filesystem::path path_;
};

}  // namespace rnmbake
