#include "blender/private_environment.h"

namespace rnmbake {

namespace fs = std::filesystem;

std::vector<std::pair<std::string, std::optional<std::string>>> private_environment(
    const fs::path& folder, const fs::path& bytecode) {
  const fs::path root = fs::absolute(folder);
  std::vector<std::pair<std::string, std::optional<std::string>>> changes = {
      {"HOME", (root / "home").string()}, {"TMPDIR", (root / "tmp").string()}};
  if (bytecode.empty()) {
    changes.emplace_back("PYTHONDONTWRITEBYTECODE", "1");
  } else {
    changes.emplace_back("PYTHONDONTWRITEBYTECODE", std::nullopt);
    changes.emplace_back("PYTHONPYCACHEPREFIX", fs::absolute(bytecode).string());
  }
  for (const char* name : {"TEMP", "TMP", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_DATA_HOME",
                           "XDG_STATE_HOME", "BLENDER_USER_RESOURCES", "BLENDER_USER_CONFIG",
                           "BLENDER_USER_SCRIPTS", "BLENDER_USER_EXTENSIONS", "BLENDER_USER_DATAFILES",
                           "PYTHONPATH", "PYTHONHOME", "PYTHONSTARTUP", "DISPLAY", "WAYLAND_DISPLAY"}) {
    changes.emplace_back(name, std::nullopt);
  }
  return changes;
}

}  // namespace rnmbake
