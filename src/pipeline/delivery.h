// pipeline/delivery.h - collects what was baked and writes a target's lightmap as soon as all of it is there.
#pragma once

#include "bake/plan.h"
#include "bake/request.h"
#include "scene/surface.h"
#include "config/bake_settings.h"
#include "lightmap/merge.h"
#include "lightmap/metadata.h"

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace rnmbake {

/// One lightmap that was written.
struct Delivered {
  std::vector<std::string> files;  // names within the output folder
  MergeCounts counts;
};
struct NotDelivered {
  std::string reason;
};
/// How it ended for a target; empty: not yet.
using Delivery = std::optional<std::variant<Delivered, NotDelivered>>;

/// What is known of a target besides its geometry.
struct DeliveryNote {
  std::string stem;           // of its file names
  LightmapMetadata metadata;  // for the headers
  int dilate = 4;
  std::shared_ptr<const Surface> surface;  // where the identity or the frames need it
};

/// Thread-safe. Writing errors (a full disk) are thrown: they concern every target that is left.
class DeliveryDesk {
 public:
  DeliveryDesk(const BakeContext& context, const OutputSettings& output, std::vector<DeliveryNote> notes);

  /// Takes the tiles of a dispatch (in the layout's order); writes each target that became complete.
  void take(const Dispatch& dispatch, const DispatchLayout& layout, std::vector<FloatImage> pictures);

  /// Gives a target up; what comes for it later is thrown away.
  void give_up(std::size_t target, const std::string& reason);

  [[nodiscard]] bool is_settled(std::size_t target) const;
  [[nodiscard]] const std::vector<Delivery>& deliveries() const { return deliveries_; }

 private:
  struct Shelf {
    std::size_t missing = 0;                     // units
    std::map<std::size_t, FloatImage> pictures;  // by tile
  };
  [[nodiscard]] Delivery finish(std::size_t target, Shelf&& shelf) const;
  [[nodiscard]] std::vector<std::string> write(const std::string& stem, LayeredImage image) const;

  BakeContext context_;
  OutputSettings output_;
  std::vector<DeliveryNote> notes_;
  mutable std::mutex mutex_;
  std::vector<Shelf> shelves_;
  std::vector<Delivery> deliveries_;
};

}  // namespace rnmbake
