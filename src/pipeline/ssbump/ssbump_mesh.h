// pipeline/ssbump/ssbump_mesh.h - self-shadowed bump maps of detailed meshes: files in, maps of a low mesh
// out.
#pragma once

#include "blender/blender_session.h"
#include "image/float_image.h"
#include "ssbump/mesh/mesh_occlusion.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

struct SsbumpMeshOptions {
  enum class Missing { fill, mark };

  std::filesystem::path high;                  // .blend, .glb, .gltf, .obj
  std::vector<std::string> onto;               // such files, or patterns of objects in `high`
  std::vector<std::string> high_objects{"*"};  // patterns; objects of `onto` are excluded
  std::vector<std::string> low_objects{"*"};   // patterns, for the files of `onto`
  std::string uv;                              // layer of the low objects; "": the active-render one
  bool allow_overlap = false;                  // of UVs: the last face wins
  Missing missing = Missing::fill;  // texels without detail: from their neighbours, or 0 in every channel
  int dilate = 8;                   // texels beyond the faces
  MeshOcclusionOptions measure;     // cage 0: default_cage()
};

struct SsbumpMesh {
  MeshOcclusion maps;                // weights, normal and height filled and dilated
  std::vector<std::string> objects;  // the low ones, keys; MeshOcclusion::surfaces in the same order
  double cage = 0;                   // that was used
  std::string blender_version;       // that read the meshes
};

/// Reads the meshes by Blender and measures. All low objects share one picture. Warns of texels without
/// detail. Throws Error(invalid_input) where a low object has no UVs, or they overlap, or no texel finds
/// detail; Error(usage) where a pattern fits no object; Interrupted.
[[nodiscard]] SsbumpMesh measure_ssbump_mesh(BlenderSession& session, const SsbumpMeshOptions& options);

}  // namespace rnmbake
