#include "pipeline/reference/kept_traces.h"

#include "base/bytes.h"
#include "base/hash.h"
#include "pipeline/run/result_store.h"

#include <algorithm>

namespace rnmbake {
namespace {

// Without gaps between members, whose bytes would be anything.
static_assert(sizeof(SurfaceCorner) == 16 * sizeof(float));
static_assert(sizeof(SurfaceTriangle) == 3 * sizeof(SurfaceCorner) + 5 * sizeof(float));

void add_direction(KeyMaker& key, const Vec3& direction) {
  for (int axis = 0; axis < 3; ++axis) key.add("axis", double(direction[axis]));
}

void add_options(KeyMaker& key, const GatherOptions& options) {
  for (const BasisDirection& basis : options.directions) add_direction(key, basis.direction);
  key.add("harmonics", std::int64_t{options.sh_order});
  key.add("footprint", std::int64_t(options.footprint)).add("past edge", std::int64_t(options.past_edge));
  key.add("samples", std::int64_t{options.samples}).add("error", options.error);
  key.add("bounces", std::int64_t{options.bounces}).add("seed", std::int64_t(options.seed));
  key.add("blender", options.blender_version);
  const RecipeFaults& faults = options.faults;
  for (const bool fault : {faults.tilt_clamp, faults.bump_shadowing, faults.self_reflection,
                           faults.below_horizon, faults.no_diffuse})
    key.add("fault", std::int64_t{fault});
}

void add_target(KeyMaker& key, const GatherTarget& target) {
  key.add("surface", hash128_hex(bytes_of(target.surface->triangles)));
  key.add("object", std::int64_t(target.object)).add("stream", std::int64_t(target.stream));
  key.add("width", std::int64_t{target.width}).add("height", std::int64_t{target.height});
}

}  // namespace

KeptTraces::KeptTraces(const TraceCache& cache, std::span<const GatherTarget> targets,
                       const GatherOptions& options)
    : cache_(cache), directions_(options.faults.self_reflection ? options.directions.size() : 0) {
  if (!cache_.is_on()) return;
  for (const GatherTarget& target : targets) {
    KeyMaker key;
    key.add("scene", cache_.content).add("program", program_hash());
    add_options(key, options);
    add_target(key, target);
    targets_.push_back(key.make("traced"));
  }
}

ResultKey KeptTraces::key_of(const GatherPart& part) const {
  KeyMaker key;
  key.add("target", targets_[part.target]).add("direction", std::int64_t{part.direction});
  if (part.round != GatherPart::last_round) {
    key.add("round", std::int64_t{part.round});
    key.add("first", std::int64_t(part.first_block)).add("blocks", std::int64_t(part.blocks));
  }
  return key.make("traced");
}

bool KeptTraces::has(std::size_t target) const {
  if (!cache_.is_on() || cache_.anew) return false;
  GatherPart part;
  part.target = target;
  if (directions_ == 0) return cache_.store->has(key_of(part));
  for (std::size_t k = 0; k < directions_; ++k) {
    part.direction = static_cast<int>(k);
    if (!cache_.store->has(key_of(part))) return false;
  }
  return true;
}

std::optional<std::string> KeptTraces::find(const GatherPart& part) {
  if (!cache_.is_on() || cache_.anew) return std::nullopt;
  const ResultKey key = key_of(part);
  auto bytes = cache_.store->get(key);
  if (bytes && part.round != GatherPart::last_round) {
    const std::lock_guard lock(mutex_);
    parts_[part.target].push_back(key);
  }
  return bytes;
}

void KeptTraces::keep(const GatherPart& part, const std::string& bytes) {
  if (!cache_.is_on()) return;
  const ResultKey key = key_of(part);
  if (cache_.anew) cache_.store->remove(key);
  cache_.store->put(key, bytes);
  const std::lock_guard lock(mutex_);
  std::vector<ResultKey>& parts = parts_[part.target];
  if (part.round != GatherPart::last_round) return parts.push_back(key);
  for (const ResultKey& one : parts) cache_.store->remove(one);
  parts.clear();
}

}  // namespace rnmbake
