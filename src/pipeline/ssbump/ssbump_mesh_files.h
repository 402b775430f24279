// pipeline/ssbump/ssbump_mesh_files.h - maps of a mesh, as the files of a height map.
#pragma once

#include "pipeline/ssbump/ssbump_mesh.h"
#include "pipeline/ssbump/ssbump_run.h"

namespace rnmbake {

/// The map, and where `options` names them the detail's normals and its heights over the low surface: world
/// units in float files, else their range as 0 to 1. All files are in place at the end, or none is.
SsbumpRunSummary write_ssbump_mesh(const SsbumpMesh& mesh, const SsbumpRunOptions& options);

}  // namespace rnmbake
