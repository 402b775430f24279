// cli/shaders/shaders_blender.h - `rnmbake shaders --engine blender`: decoders as groups of nodes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

inline constexpr const char* blender_engine = "blender";

/// `output`: a folder, which gets rnmbake_nodes.blend, or a file that ends in .blend. `blender`: as
/// --blender; may be empty. `keep_temporary`: leave what Blender was given and gave. Throws Error(usage)
/// where a name has no group or there is no output, else as write_node_groups().
void run_shaders_blender(const std::vector<std::string>& names, std::filesystem::path output,
                         const std::string& blender, bool keep_temporary);

}  // namespace rnmbake
