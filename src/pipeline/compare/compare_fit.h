// pipeline/compare/compare_fit.h - checks that two lightmaps have the same encoding and units.
#pragma once

#include "pipeline/lightmaps/lightmap_folder.h"

#include <string>
#include <vector>

namespace rnmbake {

/// Throws Error(invalid_input) naming the object, both files and the difference, where size, encoding, units,
/// space, handedness, green, normalisation or the vector of a common basis differ.
void check_fit(const std::string& key, const LoadedLightmap& one, const LoadedLightmap& other);

/// The same, and that the two were baked with different seeds: else their difference is no noise.
void check_halves(const std::string& key, const LoadedLightmap& first, const LoadedLightmap& second);

/// Names of the bases whose layers all of these have, in the order of the first; "flat" for the plain layer.
[[nodiscard]] std::vector<std::string> common_bases(const std::vector<const LoadedLightmap*>& lightmaps);

/// The layer of a basis, of its standard error (`suffix` "_stderr"), or nothing.
[[nodiscard]] const FloatImage* basis_layer(const LoadedLightmap& lightmap, const std::string& basis,
                                            const std::string& suffix = "");

}  // namespace rnmbake
