// pipeline/lightmaps/bake_collector.h - collects baked pictures and writes a target's lightmap as soon as all
// of its tasks are complete.
#pragma once

#include "bake/plan.h"
#include "bake/request.h"
#include "config/bake_settings.h"
#include "pipeline/dispatch/picture_sink.h"
#include "pipeline/lightmaps/bounced_light.h"
#include "pipeline/lightmaps/deliver_lightmap.h"
#include "pipeline/lightmaps/preview_pictures.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace rnmbake {

/// Thread-safe. Throws Error(io) where a file cannot be written: the remaining targets would meet the same
/// disk.
class BakeCollector : public PictureSink {
 public:
  /// `preview`: pictures to look at lie in DIR/preview while it bakes. `bounced`: of recipe gather, whose
  /// plan has mirrors beside receivers.
  BakeCollector(const BakeContext& context, const OutputSettings& output, std::vector<LightmapHeader> headers,
                bool preview = false, const BouncedLightSource* bounced = nullptr);

  /// Writes each target that became complete.
  void take(const Batch& batch, const BatchLayout& layout, std::vector<BakedPicture> pictures) override;
  void preview(const BatchLayout& layout, const std::vector<BakedPicture>& pictures) override;
  void give_up(std::size_t target, const std::string& reason) override;
  [[nodiscard]] bool is_settled(std::size_t target) const override;
  [[nodiscard]] const std::vector<Delivery>& deliveries() const { return deliveries_; }

 private:
  struct PendingTarget {
    std::size_t missing = 0;                       // tasks
    std::map<std::size_t, BakedPicture> pictures;  // by atlas rectangle
  };
  [[nodiscard]] Delivery finish(std::size_t target, PendingTarget&& pending) const;

  BakeContext context_;
  OutputSettings output_;
  std::vector<LightmapHeader> headers_;
  const BouncedLightSource* bounced_;
  std::unique_ptr<PreviewPictures> previews_;  // of headers_; null: nobody asked
  mutable std::mutex mutex_;
  std::vector<PendingTarget> pending_;
  std::vector<Delivery> deliveries_;
};

}  // namespace rnmbake
