// cli/ssbump/ssbump_mesh_flags.h - flags of rnmbake ssbump that need Blender: detail from meshes, height maps
// by Cycles.
#pragma once

#include "config/resolve.h"
#include "pipeline/ssbump/ssbump_blender.h"
#include "pipeline/ssbump/ssbump_mesh.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace CLI {
class App;
}  // namespace CLI

namespace rnmbake {

/// Flags of the command that hold for every method.
struct SsbumpRays {
  int rays = 250;
  double power = 1;
  std::uint64_t seed = 0;
  int threads = 0;  // 0: all cores
};

/// Must live as long as `command`.
class SsbumpMeshFlags {
 public:
  explicit SsbumpMeshFlags(CLI::App& command);
  SsbumpMeshFlags(const SsbumpMeshFlags&) = delete;
  SsbumpMeshFlags& operator=(const SsbumpMeshFlags&) = delete;

  /// --from-mesh was given: there is no height map then.
  [[nodiscard]] bool from_mesh() const { return !options_.high.empty(); }

  /// After parsing. Throws Error(usage) where flags do not fit together: `has_input`, a height map was named.
  void check(bool has_input) const;

  /// For --from-mesh.
  [[nodiscard]] SsbumpMesh measure(const SsbumpRays& rays) const;

  /// For --method blender. Throws Error(unsupported) for powers other than 1.
  [[nodiscard]] SsbumpWeights bake(const HeightField& field, const SsbumpRays& rays) const;

 private:
  [[nodiscard]] ResolvedConfig config(const SsbumpRays& rays) const;

  SsbumpMeshOptions options_;
  std::string size_, missing_ = "fill", lights_ = "sky", blender_;
  bool allow_scripts_ = false, sandbox_ = false, keep_temporary_ = false;
};

/// "512" or "512x256"; nullopt where it is no size of 1 to 16384 texels a side.
[[nodiscard]] std::optional<std::pair<int, int>> texel_size(const std::string& text);

}  // namespace rnmbake
