// cli/ssbump/ssbump_flags.h - the flags of `rnmbake ssbump INPUT`, turned into the options of a run.
#pragma once

#include "cli/ssbump/ssbump_mesh_flags.h"
#include "pipeline/ssbump/ssbump_run.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace rnmbake {

class SsbumpFlags {
 public:
  explicit SsbumpFlags(CLI::App& command);

  /// Throws Error(usage) for values that contradict each other.
  [[nodiscard]] SsbumpRunOptions options() const;

  /// Whether detail comes from a mesh, and that mesh measured.
  [[nodiscard]] bool from_mesh() const { return meshes_.from_mesh(); }
  [[nodiscard]] SsbumpMesh measure() const { return meshes_.measure(rays()); }

  bool json = false;
  std::filesystem::path input;

 private:
  void add_height_flags(CLI::App& command);
  void add_surface_flags(CLI::App& command);
  void add_method_flags(CLI::App& command);
  void add_output_flags(CLI::App& command);
  [[nodiscard]] HeightOptions height_options() const;
  [[nodiscard]] std::optional<double> texels_high() const;
  [[nodiscard]] GenerateOptions generate_options() const;
  [[nodiscard]] SsbumpOutput output_options() const;

  void add_direction_flags(CLI::App& command);
  [[nodiscard]] std::optional<DirectionOptions> direction_options() const;
  [[nodiscard]] SsbumpRays rays() const;
  void check_files(const SsbumpRunOptions& options) const;

  SsbumpMeshFlags meshes_;
  SsbumpRunOptions run_;
  std::optional<double> height_, height_world_, texel_size_;
  std::uint64_t memory_mib_ = 0;
  std::string wrap_ = "x,y", method_, scale_ = "third", handed_ = "right", alpha_ = "none", bits_, basis_set_,
              fit_ = "free";
  bool alpha_ao_ = false;
};

/// "x,y", "x", "y", "none", "mirror", or one word for each axis such as "mirror,none". Throws Error(usage).
void parse_wrap(const std::string& text, WrapMode& x, WrapMode& y);

}  // namespace rnmbake
