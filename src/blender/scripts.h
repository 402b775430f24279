// blender/scripts.h - the Python scripts that Blender runs: carried in the binary, unpacked to a private
// folder.
#pragma once

#include "base/files.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rnmbake {

/// Generated at build time by cmake/Embed.cmake; names below blender_scripts/ with their
/// texts.
const std::vector<std::pair<const char*, const char*>>& embedded_scripts();

/// Hash of what they do: of the .py files below a folder; "": of the embedded ones.
std::string scripts_hash(const std::filesystem::path& instead);

/// A folder with all scripts for as long as this object lives.
class ScriptFolder {
 public:
  /// `instead`: use this folder as it is (--scripts). Error(usage) if it is none.
  explicit ScriptFolder(const std::optional<std::filesystem::path>& instead = {});

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Folder of Python's bytecode, for later launches: Debian's Blender comes without, and compiling its
  /// add-ons is half of its start.
  [[nodiscard]] const std::filesystem::path& bytecode() const { return bytecode_.path(); }

  /// The path of an entry script. Error(environment) if there is none of that name.
  [[nodiscard]] std::filesystem::path entry(const std::string& name) const;

 private:
  std::optional<TempFolder> unpacked_;
  TempFolder bytecode_;
  std::filesystem::path path_;
};

}  // namespace rnmbake
