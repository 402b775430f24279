// pipeline/lightmaps/bake_collector.h - collects what was baked and writes a target's lightmap as soon as all
// of it is there.
#pragma once

#include "bake/plan.h"
#include "bake/request.h"
#include "config/bake_settings.h"
#include "pipeline/lightmaps/deliver_lightmap.h"

#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace rnmbake {

/// Thread-safe. Writing errors (a full disk) are thrown: they concern every target that is left.
class BakeCollector {
 public:
  BakeCollector(const BakeContext& context, const OutputSettings& output,
                std::vector<LightmapHeader> headers);

  /// Takes the pictures of a batch (in the layout's order); writes each target that became complete.
  void take(const Batch& batch, const BatchLayout& layout, std::vector<FloatImage> pictures);

  /// Gives a target up; what comes for it later is thrown away.
  void give_up(std::size_t target, const std::string& reason);

  [[nodiscard]] bool is_settled(std::size_t target) const;
  [[nodiscard]] const std::vector<Delivery>& deliveries() const { return deliveries_; }

 private:
  struct PendingTarget {
    std::size_t missing = 0;                     // tasks
    std::map<std::size_t, FloatImage> pictures;  // by atlas rectangle
  };
  [[nodiscard]] Delivery finish(std::size_t target, PendingTarget&& pending) const;

  BakeContext context_;
  OutputSettings output_;
  std::vector<LightmapHeader> headers_;
  mutable std::mutex mutex_;
  std::vector<PendingTarget> pending_;
  std::vector<Delivery> deliveries_;
};

}  // namespace rnmbake
