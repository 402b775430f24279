// pipeline/validate/decompose.h - the error of the published recipe, taken apart into causes.
#pragma once

#include "report/comparison.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

/// Folders of two bakes that differ only in their seeds.
struct Halves {
  std::filesystem::path first, second;
};

/// Folders with the lightmaps of the same targets.
struct DecomposeInput {
  std::filesystem::path truth;
  struct Emulated {
    std::string cause;           // the fault that was added
    std::filesystem::path path;  // traced with this and all earlier ones
  };
  std::vector<Emulated> emulated;
  Halves recipe, receiver;  // baked from the lambert scene
  /// The same with the scene's own materials; none where these are diffuse anyway.
  std::optional<Halves> own_recipe, own_receiver;
};

/// Decompositions of the whole scene and then of each object that all folders have. With R the recipe's bake,
/// C the receiver's, T the truth, E_k what was traced with the first k faults, and a dash for own materials:
///     R' - T = sum (E_k - E_k-1)  one row for each cause
///            + (R' - C') - (R - C)  "non-Lambertian diffuse": own materials as the recipe alone sees them
///            + C' - C              "model difference": light that the reference's model does not carry
///            + R - E_n             "residual": what no cause explains
/// with the noise taken out of every size; the "noise" row says how large that of R' is.
[[nodiscard]] std::vector<Decomposition> decompose(const DecomposeInput& input);

}  // namespace rnmbake
