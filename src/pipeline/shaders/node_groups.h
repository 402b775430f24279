// pipeline/shaders/node_groups.h - the decoders as groups of nodes in a .blend, for artists to append.
#pragma once

#include "blender/blender_session.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

/// Names of encodings (encoding/codecs/make_codec.h), each of which has a group: each once, or all where none
/// is given. Throws Error(usage) for one that has no group.
[[nodiscard]] std::vector<std::string> checked_node_groups(const std::vector<std::string>& names);

/// Launches Blender, which writes `file` (.blend, whole or not at all): a library without a scene that holds
/// a group `rnmbake NAME` for each name, made by blender_scripts/nodes/decoders.py. Throws as
/// BlenderSession::run() and Error(io).
void write_node_groups(BlenderSession& session, const std::vector<std::string>& names,
                       const std::filesystem::path& file);

}  // namespace rnmbake
