// ssbump/generate/generate.h - from a height field to the weights of its self-shadowed bump map.
#pragma once

#include "ssbump/generate_options.h"
#include "ssbump/heights/height_field.h"
#include "ssbump/map/weights.h"

#include <functional>

namespace rnmbake {

/// Deterministic for a seed at any number of threads. Heights must be finite. `progress` receives the share
/// that is done, from any thread; `stop` is polled, and once it says true the result is unfinished.
SsbumpWeights generate(const HeightField& field, const GenerateOptions& options,
                       const std::function<void(double)>& progress = {},
                       const std::function<bool()>& stop = {});

/// generate() for maps whose weights do not fit into memory: `done` receives all rows in order, some at a
/// time, from the calling thread. Their number does not change their values.
void generate_rows(const HeightField& field, const GenerateOptions& options,
                   const std::function<void(int first_row, const SsbumpWeights& rows)>& done,
                   const std::function<void(double)>& progress = {}, const std::function<bool()>& stop = {});

}  // namespace rnmbake
