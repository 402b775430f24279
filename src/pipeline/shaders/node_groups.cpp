#include "pipeline/shaders/node_groups.h"

#include "base/error.h"
#include "base/files.h"
#include "base/names.h"
#include "encoding/codecs/make_codec.h"

#include <algorithm>
#include <utility>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {

namespace fs = std::filesystem;

std::vector<std::string> checked_node_groups(const std::vector<std::string>& names) {
  std::vector<std::string> known = codec_names();
  if (names.empty()) return known;
  std::vector<std::string> chosen;
  for (const std::string& name : names) {
    if (std::ranges::find(known, name) == known.end()) {
      const std::string hint = did_you_mean(name, known);
      fail(ExitCode::usage, "there is no node group '{}'{}", name,
           hint.empty() ? fmt::format("; choose of {}", fmt::join(known, ", ")) : hint);
    }
    if (std::ranges::find(chosen, name) == chosen.end()) chosen.push_back(name);
  }
  return chosen;
}

void write_node_groups(BlenderSession& session, const std::vector<std::string>& names, const fs::path& file) {
  write_atomically(fs::absolute(file), [&](const fs::path& temporary) {
    Launch launch;
    launch.entry = "node_groups_entry.py";
    launch.folder = session.new_folder("node-groups");
    launch.request = {{"encodings", names}};
    launch.save_as = temporary;
    (void)session.run(std::move(launch));
  });
}

}  // namespace rnmbake
