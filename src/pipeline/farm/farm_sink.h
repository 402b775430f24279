// pipeline/farm/farm_sink.h - remembers what was given up; pictures stay in the cache alone.
#pragma once

#include "pipeline/dispatch/picture_sink.h"

#include <cstddef>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace rnmbake {

class FarmSink : public PictureSink {
 public:
  void take(const Batch& batch, const BatchLayout& layout, std::vector<BakedPicture> pictures) override;
  void give_up(std::size_t target, const std::string& reason) override;
  [[nodiscard]] bool is_settled(std::size_t target) const override;

  /// Target -> the first reason.
  [[nodiscard]] const std::map<std::size_t, std::string>& given_up() const { return given_up_; }
  /// Batches, or whole targets, that were taken.
  [[nodiscard]] std::size_t taken() const { return taken_; }

 private:
  mutable std::mutex mutex_;
  std::map<std::size_t, std::string> given_up_;
  std::size_t taken_ = 0;
};

}  // namespace rnmbake
