// pipeline/dispatch/picture_sink.h - where the pictures of launches go.
#pragma once

#include "bake/baked_picture.h"
#include "bake/plan.h"
#include "bake/request.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rnmbake {

/// Makes what is wanted of baked pictures. Called by several threads. A target is *settled* once it was
/// delivered or given up: its remaining tasks need not be baked.
class PictureSink {
 public:
  PictureSink() = default;
  PictureSink(const PictureSink&) = delete;
  PictureSink& operator=(const PictureSink&) = delete;
  virtual ~PictureSink() = default;

  /// Takes the pictures of a batch with all of their passes, in the layout's order. What it throws ends the
  /// run.
  virtual void take(const Batch& batch, const BatchLayout& layout, std::vector<BakedPicture> pictures) = 0;

  /// Shows what the first passes of a batch have brought.
  virtual void preview(const BatchLayout& /*layout*/, const std::vector<BakedPicture>& /*pictures*/) {}

  /// Gives a target up; later pictures of it are discarded.
  virtual void give_up(std::size_t target, const std::string& reason) = 0;

  [[nodiscard]] virtual bool is_settled(std::size_t target) const = 0;
};

}  // namespace rnmbake
