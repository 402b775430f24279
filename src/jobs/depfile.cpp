#include "jobs/depfile.h"

#include "base/files.h"
#include "base/log.h"

#include <set>

namespace rnmbake {
namespace {

/// As GCC's -MD writes names: backslashes count only where they stand before something that is escaped.
std::string make_escaped(const std::string& name) {
  std::string out;
  std::size_t backslashes = 0;
  for (const char letter : name) {
    if (letter == '$') {
      out += '$';
    } else if (letter == ' ' || letter == '\t' || letter == '#' || letter == ':') {
      out.append(backslashes + 1, '\\');
    }
    backslashes = letter == '\\' ? backslashes + 1 : 0;
    out += letter;
  }
  return out;
}

}  // namespace

std::string depfile_text(const std::filesystem::path& target,
                         const std::vector<std::filesystem::path>& inputs) {
  std::string out = make_escaped(target.string()) + ":";
  std::set<std::string> said;
  for (const std::filesystem::path& input : inputs) {
    const std::string name = input.string();
    if (name.empty() || !said.insert(name).second) continue;
    if (name.find('\n') != std::string::npos) {
      log::warn("{}: left out of the list of inputs, as make cannot read a name with a line break", name);
      continue;
    }
    out += " \\\n  " + make_escaped(name);
  }
  return out + "\n";
}

void write_depfile(const std::filesystem::path& file, const std::filesystem::path& target,
                   const std::vector<std::filesystem::path>& inputs) {
  if (file.has_parent_path()) make_folders(file.parent_path());
  write_atomically(file, depfile_text(target, inputs));
}

}  // namespace rnmbake
