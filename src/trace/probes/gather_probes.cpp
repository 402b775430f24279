#include "trace/probes/gather_probes.h"

#include "trace/block.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

constexpr int wanted_batches = 16;

/// Points 2i and 2i + 1 look up and down from probe i, with the world's axes for their frames.
class ProbeHalves : public PointSource {
 public:
  explicit ProbeHalves(std::span<const Vec3> positions) : positions_(positions) {}
  [[nodiscard]] std::size_t size() const override { return 2 * positions_.size(); }
  [[nodiscard]] GatherPoint sample(std::size_t index, const Vec2& /*u*/) const override {
    GatherPoint point;
    point.position = positions_[index / 2];
    point.face = Vec3(0, 0, index % 2 == 0 ? 1.0F : -1.0F);
    point.frame = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), 1};
    return point;
  }

 private:
  std::span<const Vec3> positions_;
};

GatherOptions options_for(const ProbeGatherOptions& options) {
  GatherOptions gather;
  for (const Vec3& direction : options.directions) gather.directions.push_back({"", direction});
  gather.sh_order = 3;
  gather.samples = options.samples;
  gather.bounces = options.bounces;
  gather.seed = options.seed;
  gather.direct = options.direct;
  return gather;
}

/// Adds up both halves, whose errors are independent.
void add_probe(const BatchStatistics& statistics, std::size_t first, GatheredProbe& probe) {
  const std::size_t directions = probe.irradiance.size();
  for (std::size_t k = 0; k < directions; ++k) {
    probe.irradiance[k] = statistics.mean(first, k) + statistics.mean(first + 1, k);
    const Vec3 square = statistics.squared_error(first, k) + statistics.squared_error(first + 1, k);
    probe.standard_error[k] = Vec3(std::sqrt(square.x), std::sqrt(square.y), std::sqrt(square.z));
  }
  for (std::size_t c = 0; c < probe.harmonics.size(); ++c)
    probe.harmonics[c] = statistics.mean(first, directions + c) + statistics.mean(first + 1, directions + c);
}

}  // namespace

std::vector<GatheredProbe> gather_probes(const TraceScene& scene, std::span<const Vec3> positions,
                                         const ProbeGatherOptions& options,
                                         const std::function<void(double)>& progress,
                                         const std::function<bool()>& stop) {
  const GatherOptions gather = options_for(options);
  const ProbeHalves halves(positions);
  const Vec3 none(0);
  GatheredProbe dark;
  dark.irradiance.resize(options.directions.size(), none);
  dark.standard_error = dark.irradiance;
  dark.harmonics.fill(none);
  std::vector<GatheredProbe> probes(positions.size(), dark);
  constexpr std::size_t block = BlockGatherer::most_points;
  const std::size_t blocks = (halves.size() + block - 1) / block;
  const int batch_samples = std::max(1, options.samples / wanted_batches);
  const int batches = (options.samples + batch_samples - 1) / batch_samples;
  std::mutex mutex;
  std::size_t done = 0;
  std::atomic<bool> stopped = false;
  const auto gather_block = [&](std::size_t b) {
    const std::size_t first = b * block, count = std::min(block, halves.size() - first);
    BlockGatherer gatherer(scene, halves, gather, nullptr);
    BatchStatistics statistics(count, gatherer.values());
    for (int batch = 0; batch < batches; ++batch) {
      if (stopped || (stop && stop())) {
        stopped = true;
        return;
      }
      const std::uint64_t seed = hash_of(hash_of(options.seed, b), static_cast<std::uint64_t>(batch));
      gatherer.batch(first, count, batch_samples, seed, statistics);
    }
    for (std::size_t i = 0; i < count; i += 2) {
      GatheredProbe& probe = probes[(first + i) / 2];
      add_probe(statistics, i, probe);
      probe.back_faces =
          double(gatherer.back_faces()[i] + gatherer.back_faces()[i + 1]) / (2.0 * batches * batch_samples);
    }
    const std::lock_guard lock(mutex);
    ++done;
    if (progress) progress(double(done) / double(blocks));
  };
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, blocks, gather_block); });
  return probes;
}

}  // namespace rnmbake
