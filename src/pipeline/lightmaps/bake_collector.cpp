#include "pipeline/lightmaps/bake_collector.h"

#include "bake/assemble.h"
#include "base/error.h"
#include "lightmap/half_errors.h"

#include <array>
#include <utility>

namespace rnmbake {

BakeCollector::BakeCollector(const BakeContext& context, const OutputSettings& output,
                             std::vector<LightmapHeader> headers, bool preview,
                             const BouncedLightSource* bounced)
    : context_(context),
      output_(output),
      headers_(std::move(headers)),
      bounced_(bounced),
      previews_(preview ? std::make_unique<PreviewPictures>(context_, output_, headers_) : nullptr),
      pending_(headers_.size()),
      deliveries_(headers_.size()) {
  for (const BakeTask& task : context.plan.tasks) ++pending_[task.target].missing;
}

void BakeCollector::take(const Batch& batch, const BatchLayout& layout, std::vector<BakedPicture> pictures) {
  std::vector<std::pair<std::size_t, PendingTarget>> complete;
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const std::size_t rect = layout.rects[i];
      const std::size_t target = context_.plan.rects[rect].target;
      if (!deliveries_[target]) pending_[target].pictures[rect] = std::move(pictures[i]);
    }
    for (const std::size_t task : batch.tasks) {
      const std::size_t target = context_.plan.tasks[task].target;
      if (deliveries_[target]) continue;
      if (--pending_[target].missing == 0) complete.emplace_back(target, std::exchange(pending_[target], {}));
    }
  }
  for (auto& [target, pending] : complete) {
    Delivery delivery = finish(target, std::move(pending));
    if (previews_) previews_->finish(target);
    const std::lock_guard lock(mutex_);
    deliveries_[target] = std::move(delivery);
  }
}

void BakeCollector::preview(const BatchLayout& layout, const std::vector<BakedPicture>& pictures) {
  if (previews_) previews_->take(layout, pictures);
}

void BakeCollector::give_up(std::size_t target, const std::string& reason) {
  if (previews_) previews_->finish(target);
  const std::lock_guard lock(mutex_);
  if (deliveries_[target]) return;
  const std::string& key = context_.targets[target].key;
  deliveries_[target] = not_delivered(key, reason, key + ": " + reason);
  pending_[target].pictures.clear();
}

bool BakeCollector::is_settled(std::size_t target) const {
  const std::lock_guard lock(mutex_);
  return deliveries_[target].has_value();
}

Delivery BakeCollector::finish(std::size_t target_index, PendingTarget&& pending) const {
  const Target& target = context_.targets[target_index];
  std::vector<const AtlasRect*> rects;
  std::vector<FloatImage> means;
  std::array<std::vector<FloatImage>, 2> halves;
  bool has_error = true;
  const BakedPicture& any = pending.pictures.begin()->second;
  const double variance_factor = any.variance_factor();
  LightmapHeader header = headers_[target_index];
  header.metadata.samples = any.all_samples();
  BouncedLight bounced_light;
  if (bounced_ != nullptr) bounced_light = bounced_->gather(target_index, context_.plan, pending.pictures);
  for (auto& [rect, picture] : pending.pictures) {
    if (context_.plan.rects[rect].pass.role == ReceiverPass::Role::mirrors) continue;
    rects.push_back(&context_.plan.rects[rect]);
    means.push_back(picture.mean());
    has_error = has_error && picture.has_error();
    for (const std::size_t half : {0U, 1U}) halves[half].push_back(std::move(picture.halves[half]));
  }
  const auto assembled = [&](const std::vector<FloatImage>& pictures, std::array<float, 2> shares,
                             bool frames) {
    TargetBakes bakes = assemble(target, rects, pictures, context_.bases, header.surface.get(), frames);
    for (const std::size_t half : {0U, 1U}) {
      if (shares[half] > 0) add_light(bounced_light[half], shares[half], bakes);
    }
    return bakes;
  };
  try {
    const TargetBakes bakes = assembled(means, {0.5F, 0.5F}, output_.frames);
    if (!has_error) return deliver_lightmap(bakes, header, output_);
    HalfErrors errors = half_errors(assembled(halves[0], {1, 0}, false), assembled(halves[1], {0, 1}, false),
                                    variance_factor);
    ExtraLayers extra;
    if (has_error_layers(output_)) extra.standard_errors = std::move(errors.layers);
    Delivered delivered = deliver_lightmap(bakes, header, output_, std::move(extra));
    delivered.standard_error = errors.relative;
    return delivered;
  } catch (const Error& error) {
    if (error.code() == ExitCode::io) throw;  // the next target would meet the same disk
    return not_delivered(target.key, error.what(), error.what());
  }
}

}  // namespace rnmbake
