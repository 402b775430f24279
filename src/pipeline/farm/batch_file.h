// pipeline/farm/batch_file.h - one batch of a plan on disk: all that its requests, and those of its pieces,
// are made from.
#pragma once

#include "bake/plan.h"

#include <filesystem>
#include <vector>

namespace rnmbake {

/// Writes batch.json, corners.f32 (position, normal, UV of each receiver corner) and fences.f32 (four corners
/// and the face's normal of each fence) into the folder, which is made; little-endian.
void write_batch(const Plan& plan, const Batch& batch, const std::filesystem::path& folder);

/// Batches of one plan as a plan of their own, one batch for each folder, with targets for each. Throws
/// Error(io), Error(invalid_input).
[[nodiscard]] Plan read_batches(const std::vector<std::filesystem::path>& folders);

}  // namespace rnmbake
