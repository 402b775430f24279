#include "blender/scripts.h"

#include "base/error.h"
#include "base/hash.h"

#include <map>

namespace rnmbake {

namespace fs = std::filesystem;

std::string scripts_hash(const fs::path& instead) {
  std::map<std::string, std::string> texts;  // by name, since folders are listed in any order
  if (instead.empty()) {
    for (const auto& [name, text] : embedded_scripts()) texts[name] = text;
  } else {
    for (const auto& entry : fs::recursive_directory_iterator(instead)) {
      if (entry.path().extension() == ".py")
        texts[fs::relative(entry.path(), instead).string()] = read_text(entry.path());
    }
  }
  std::string all;
  for (const auto& [name, text] : texts) all += name + '\0' + text + '\0';
  return hash128_hex(all);
}

ScriptFolder::ScriptFolder(const std::optional<fs::path>& instead) {
  if (instead) {
    if (!fs::is_directory(*instead)) {
      fail(ExitCode::usage, "--scripts {}: no such folder; leave the flag out to use the built-in scripts",
           instead->string());
    }
    path_ = fs::absolute(*instead);
    return;
  }
  path_ = unpacked_.emplace().path();
  for (const auto& [name, text] : embedded_scripts()) {
    const fs::path file = path_ / name;
    make_folders(file.parent_path());
    write_atomically(file, text);
  }
}

fs::path ScriptFolder::entry(const std::string& name) const {
  fs::path file = path_ / name;
  if (!fs::is_regular_file(file)) fail(ExitCode::environment, "the script {} is missing", file.string());
  return file;
}

}  // namespace rnmbake
