// trace/gather.h - the reference: unbiased E/pi of every texel of a target, for all directions in one pass.
#pragma once

#include "trace/gather_options.h"
#include "trace/gather_store.h"
#include "trace/scene.h"

#include <functional>
#include <span>

namespace rnmbake {

/// With RecipeFaults the result is what the published recipe bakes; self-reflection traces each direction
/// apart. Deterministic for a seed at any number of threads. `done` receives each target when it is complete,
/// on the calling thread. `stop` is polled; gather() returns as soon as it is true. What `kept` holds is not
/// gathered again, and what is gathered is kept there; the result is the same.
void gather(const TraceScene& scene, std::span<const GatherTarget> targets, const GatherOptions& options,
            const std::function<void(std::size_t, Gathered&&)>& done,
            const std::function<void(const GatherProgress&)>& progress = {},
            const std::function<bool()>& stop = {}, GatherStore* kept = nullptr);

}  // namespace rnmbake
