// pipeline/dispatch/pass_cache.h - what was baked of a scene before, pass by pass and target by target.
#pragma once

#include "bake/baked_picture.h"
#include "bake/request.h"
#include "jobs/store.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

/// A target's pictures, by its atlas rectangles in the plan's order.
using TargetPictures = std::vector<BakedPicture>;

/// A target of a plan with its tasks.
struct PlannedTarget {
  const Plan& plan;
  std::size_t target = 0;
  std::vector<std::size_t> tasks;

  [[nodiscard]] int samples() const;  // wanted
  [[nodiscard]] std::vector<std::size_t> rects() const;
};
[[nodiscard]] std::vector<PlannedTarget> planned_targets(const Plan& plan);

/// Keys name what Cycles sees (`scene`), the receivers, and the samples. Thread-safe.
class PassCache {
 public:
  /// Keeps nothing.
  PassCache() = default;
  /// `scene`: everything that light depends on, but the receivers and settings of the plan: content, Blender,
  /// scripts.
  PassCache(Store& store, ResultKey scene) : store_(&store), scene_(std::move(scene)) {}

  [[nodiscard]] bool is_on() const { return store_ != nullptr && !store_->folder().empty(); }

  /// Of a request whose arrays lie in `folder`: what is baked in its passes, and where on the atlases.
  [[nodiscard]] ResultKey key_of(const BakeRequest& request, const std::filesystem::path& folder) const;

  /// `left_out`: positions in the layout that the pass does without.
  [[nodiscard]] static ResultKey key_of(const ResultKey& request, const SamplePass& pass, int seed,
                                        const std::vector<std::size_t>& left_out);

  /// Of a target however many samples it has: all of its receivers are hashed.
  [[nodiscard]] ResultKey key_of(const PlannedTarget& target) const;
  /// Of a target with so many samples.
  [[nodiscard]] static ResultKey key_of(const ResultKey& target, int samples);

  [[nodiscard]] std::optional<std::vector<BakedPicture>> find(const ResultKey& key,
                                                              std::size_t pictures) const;
  void keep(const ResultKey& key, const std::vector<BakedPicture>& pictures) const;
  [[nodiscard]] bool has(const ResultKey& key) const { return is_on() && store_->has(key); }
  void forget(const ResultKey& key) const;

  /// The most samples, fewer than `wanted`, that the target was baked with before.
  [[nodiscard]] std::optional<TargetPictures> find_part(const ResultKey& target, int wanted,
                                                        std::size_t pictures) const;
  /// Keeps a target that has so many of its samples, for runs that want as many, or more.
  void keep_target(const ResultKey& target, const TargetPictures& pictures, int samples) const;

  /// What a run found missing when it began, so that the next one, should this one be killed, bakes the same
  /// atlases. [targets to bake] -> samples that were there.
  using Missing = std::map<std::size_t, HalfSamples>;
  [[nodiscard]] std::optional<Missing> find_journal(const ResultKey& run) const;
  void keep_journal(const ResultKey& run, const Missing& missing) const;

 private:
  [[nodiscard]] std::vector<int> samples_kept(const ResultKey& key) const;

  Store* store_ = nullptr;
  ResultKey scene_;
};

}  // namespace rnmbake
