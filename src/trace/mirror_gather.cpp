#include "trace/mirror_gather.h"

#include "trace/gather_job.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace rnmbake {

struct MirrorGather::Work {
  std::span<const char> even;
  GatherOptions options;
  GatherJob job;

  Work(const TraceScene& scene, std::span<const char> is_even, const GatherTarget& target,
       const GatherOptions& wanted)
      : even(is_even), options(wanted), job(scene, 0, target, options) {}

  [[nodiscard]] std::size_t rays_of(std::size_t texels) const {
    return texels * std::size_t(options.samples);
  }

  /// A block gathered in one batch, so that its samples are spread as evenly as they can be.
  [[nodiscard]] TexelBlock gathered(std::size_t b, const Incident& incident) const {
    constexpr std::uint64_t stage = 1;
    TexelBlock block{job.blocks()[b].first, job.blocks()[b].count, options.samples, 1, {}, 0, {}};
    job.work(
        block, stage, [](double /*share*/) { return true; }, &incident);
    return block;
  }
};

MirrorGather::MirrorGather(const TraceScene& scene, std::span<const char> even, const GatherTarget& target,
                           const GatherOptions& options)
    : work_(std::make_unique<Work>(scene, even, target, options)) {}

MirrorGather::~MirrorGather() = default;

std::size_t MirrorGather::size() const {
  return work_->rays_of(work_->job.texels());
}

std::vector<PrimaryRay> MirrorGather::rays() const {
  std::vector<PrimaryRay> all(size());
  tbb::parallel_for(std::size_t{0}, work_->job.blocks().size(), [&](std::size_t b) {
    std::vector<PrimaryRay> asked;
    const TexelBlock block = work_->gathered(b, {&asked, {}, {}});
    std::ranges::copy(asked, all.begin() + std::ptrdiff_t(work_->rays_of(block.first)));
  });
  return all;
}

MirrorGather::Result MirrorGather::gather(std::span<const Vec3> radiance) const {
  std::vector<TexelBlock> blocks(work_->job.blocks().size());
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    const TexelBlock& of = work_->job.blocks()[b];
    const auto own = radiance.subspan(work_->rays_of(of.first), work_->rays_of(of.count));
    blocks[b] = work_->gathered(b, {nullptr, own, work_->even});
  });
  Result result{work_->job.result(blocks), 0, 0};
  for (const TexelBlock& block : blocks) {
    result.lit += block.lit;
    result.shared += block.shared;
  }
  return result;
}

}  // namespace rnmbake
