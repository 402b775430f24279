#include "cli/shaders/shaders_blender.h"

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/text.h"
#include "blender/late_blender.h"
#include "config/resolve.h"
#include "pipeline/shaders/node_groups.h"
#include "process/stop.h"

namespace rnmbake {

void run_shaders_blender(const std::vector<std::string>& names, std::filesystem::path output,
                         const std::string& blender, bool keep_temporary) {
  const std::vector<std::string> groups = checked_node_groups(names);
  if (output.empty())
    fail(ExitCode::usage, "node groups do not go to stdout; give -o with a folder or a .blend");
  if (lower_extension(output) != ".blend") output /= "rnmbake_nodes.blend";
  if (output.has_parent_path()) make_folders(output.parent_path());
  ResolvedConfig config = resolve({}, read_environment(process_environment()), {});
  config.globals.scene.file = output;  // named where Blender fails
  config.globals.output.keep_temporary |= keep_temporary;
  if (!blender.empty()) config.globals.run.blender = blender;
  LateBlender installed(config.globals);
  BlenderSession session(config, installed);
  StopRequest::install();
  write_node_groups(session, groups, output);
  log::info("wrote {}", output.string());
}

}  // namespace rnmbake
