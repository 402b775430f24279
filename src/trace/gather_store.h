// trace/gather_store.h - where gathering keeps what it has, so that it can go on after it was stopped.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace rnmbake {

/// Some blocks of texels of a target after a round of samples, or all of them after the last one.
struct GatherPart {
  static constexpr int last_round = -1, all_directions = -1;

  std::size_t target = 0;
  int direction = all_directions;  // one of them, where each is gathered apart
  int round = last_round;
  std::size_t first_block = 0, blocks = 0;
};

/// Thread-safe. What it holds was made from the same scene, target and options, threads aside; bytes that it
/// cannot vouch for it does not give.
class GatherStore {
 public:
  /// Of blocks that are kept together: some seconds of a core. The same for every run, or parts are not
  /// found.
  double paths_of_part = 1 << 20;

  GatherStore() = default;
  virtual ~GatherStore() = default;
  GatherStore(const GatherStore&) = delete;
  GatherStore& operator=(const GatherStore&) = delete;

  [[nodiscard]] virtual std::optional<std::string> find(const GatherPart& part) = 0;
  virtual void keep(const GatherPart& part, const std::string& bytes) = 0;
};

}  // namespace rnmbake
