// pipeline/probes/probe_collector.h - sums baked pictures of light probes.
#pragma once

#include "bake/plan.h"
#include "base/math.h"
#include "pipeline/dispatch/picture_sink.h"

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

namespace rnmbake {

/// Positions that are one target of a plan.
struct ProbeBlock {
  std::size_t first = 0, count = 0;
};

/// A bake of all tasks with some settings, and what to do with its result.
struct ProbeTerm {
  CyclesSettings cycles;
  double sign = 1;
};

/// Sums the terms. Thread-safe.
class ProbeCollector : public PictureSink {
 public:
  /// `blocks`: [targets of the plan]. Every task has the settings of one of the terms.
  ProbeCollector(const Plan& plan, const std::vector<ProbeBlock>& blocks, std::vector<ProbeTerm> terms,
                 std::size_t directions);

  void take(const Batch& batch, const BatchLayout& layout, std::vector<BakedPicture> pictures) override;
  void give_up(std::size_t target, const std::string& reason) override;
  [[nodiscard]] bool is_settled(std::size_t target) const override;

  /// E/pi, RGB, of all positions: [positions][directions], none below 0; 0 where is_baked() is not.
  [[nodiscard]] std::vector<Vec3> irradiance() const;

  /// Standard errors of irradiance(), from the difference of two halves; empty where there are none.
  [[nodiscard]] std::vector<Vec3> standard_errors() const;

  /// Positions of complete blocks at which a texel was not baked, or is no number.
  [[nodiscard]] std::vector<std::size_t> holes() const;

  /// [positions]. All terms of all directions were there, each of them a number.
  [[nodiscard]] std::vector<bool> is_baked() const;

 private:
  struct Block {
    ProbeBlock positions;
    std::size_t missing = 0;  // tasks
    bool given_up = false;
  };
  [[nodiscard]] static bool is_complete(const Block& block) { return !block.given_up && block.missing == 0; }
  void add(const AtlasRect& rect, const BakedPicture& picture, double sign);
  [[nodiscard]] double sign_of(const BakeTask& task) const;

  const Plan& plan_;
  std::vector<ProbeTerm> terms_;
  std::size_t directions_;
  mutable std::mutex mutex_;
  std::vector<Block> blocks_;
  std::vector<Vec3d> sums_;         // [positions][directions]; of few floats, so the same in any order
  std::vector<Vec3d> differences_;  // [positions][directions] of the halves
  double variance_factor_ = 0;      // from their squares to variances; 0: no halves
  std::vector<bool> holed_;         // [positions]; a texel was not baked, or is no number
};

}  // namespace rnmbake
