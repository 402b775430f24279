// pipeline/reference/kept_traces.h - what was traced of a scene before, target by target, and parts of one.
#pragma once

#include "jobs/store.h"
#include "trace/gather_options.h"
#include "trace/gather_store.h"

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rnmbake {

/// Where traces of a scene are kept.
struct TraceCache {
  Store* store = nullptr;  // null: nothing is kept
  std::string content;     // hash of the scene as the tracer sees it
  bool anew = false;       // what is there is not used, but replaced

  [[nodiscard]] bool is_on() const { return store != nullptr && !store->folder().empty(); }
};

/// Keys name the scene, the program, the target's surface, and the options. Parts of a target are forgotten
/// once all of it is kept.
class KeptTraces : public GatherStore {
 public:
  KeptTraces(const TraceCache& cache, std::span<const GatherTarget> targets, const GatherOptions& options);

  /// Whether all of a target is there.
  [[nodiscard]] bool has(std::size_t target) const;

  [[nodiscard]] std::optional<std::string> find(const GatherPart& part) override;
  void keep(const GatherPart& part, const std::string& bytes) override;

 private:
  [[nodiscard]] ResultKey key_of(const GatherPart& part) const;

  TraceCache cache_;
  std::size_t directions_ = 0;      // that are gathered apart; 0: none are
  std::vector<ResultKey> targets_;  // none without a cache
  std::mutex mutex_;
  std::map<std::size_t, std::vector<ResultKey>> parts_;  // of targets that are not complete
};

}  // namespace rnmbake
