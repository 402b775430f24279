#include "pipeline/dispatch/kept_targets.h"

#include "base/log.h"
#include "base/text.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace rnmbake {
namespace {

/// Samples that every picture has; nothing where they differ.
std::optional<HalfSamples> samples_of(const TargetPictures& pictures) {
  if (pictures.empty()) return std::nullopt;
  const auto differs = [&](const BakedPicture& one) { return one.samples != pictures.front().samples; };
  return std::ranges::any_of(pictures, differs) ? std::nullopt : std::optional(pictures.front().samples);
}

/// Whether all that it wants is half by half in `samples`.
bool is_part(const HalfSamples& samples, int wanted) {
  const HalfSamples all = in_halves(wanted);
  return samples[0] <= all[0] && samples[1] <= all[1];
}

}  // namespace

KeptTargets::KeptTargets(const Plan& plan, const PassCache& cache, PictureSink& sink)
    : plan_(plan), cache_(cache), sink_(sink), targets_(planned_targets(plan)) {
  if (!cache_.is_on()) return;
  for (const PlannedTarget& target : targets_) keys_.push_back(cache_.key_of(target));
}

void KeptTargets::hand_over(std::size_t target, TargetPictures pictures) {
  const PlannedTarget& planned = targets_[target];
  sink_.take({planned.tasks}, {planned.rects(), {}}, std::move(pictures));
}

std::optional<TargetPictures> KeptTargets::find(std::size_t target, int samples) const {
  if (!cache_.is_on()) return std::nullopt;
  return cache_.find(PassCache::key_of(keys_[target], samples), targets_[target].rects().size());
}

std::vector<MissingBatch> KeptTargets::missing(const Cut& cut) {
  PassCache::Missing missing;
  if (cache_.is_on()) {
    KeyMaker run;
    for (const PlannedTarget& target : targets_)
      run.add("target", PassCache::key_of(keys_[target.target], target.samples()));
    run_ = run.make("journal");
  }
  std::size_t kept = 0;
  const auto journal = cache_.is_on() ? cache_.find_journal(run_) : std::nullopt;
  for (const PlannedTarget& target : targets_) {
    if (auto found = find(target.target, target.samples())) {
      ++kept;
      hand_over(target.target, std::move(*found));
      continue;
    }
    const auto part = journal || !cache_.is_on()
                          ? std::nullopt
                          : cache_.find_part(keys_[target.target], target.samples(), target.rects().size());
    const auto samples = part ? samples_of(*part) : std::nullopt;
    missing[target.target] = samples && is_part(*samples, target.samples()) ? *samples : HalfSamples{0, 0};
  }
  if (kept > 0) log::info("{} of {} baked before", kept, counted(targets_.size(), "target"));
  if (journal) {
    for (const auto& [target, samples] : *journal) {
      if (target < targets_.size()) missing[target] = samples;
    }
  } else if (!missing.empty() && cache_.is_on()) {
    cache_.keep_journal(run_, missing);
  }
  std::vector<MissingBatch> batches;
  for (const Batch& batch : plan_.batches) {
    std::map<HalfSamples, Batch> by_samples;
    for (const std::size_t task : batch.tasks) {
      const auto found = missing.find(plan_.tasks[task].target);
      if (found != missing.end()) by_samples[found->second].tasks.push_back(task);
    }
    for (const auto& [samples, tasks] : by_samples) {
      for (Batch& piece : cut(tasks)) batches.push_back({std::move(piece), samples, {}});
    }
  }
  return batches;
}

EarlierPictures KeptTargets::earlier(const MissingBatch& batch) const {
  EarlierPictures earlier;
  if (batch.done == HalfSamples{0, 0}) return earlier;
  std::map<std::size_t, TargetPictures> known;
  for (const std::size_t task : batch.batch.tasks) {
    const PlannedTarget& target = targets_[plan_.tasks[task].target];
    if (known.contains(target.target)) continue;
    auto pictures = find(target.target, batch.done[0] + batch.done[1]);
    if (!pictures || samples_of(*pictures) != batch.done) return {};  // from the beginning, all of them alike
    known[target.target] = std::move(*pictures);
  }
  for (auto& [target, pictures] : known) {
    const std::vector<std::size_t> rects = targets_[target].rects();
    for (std::size_t i = 0; i < rects.size(); ++i) earlier[rects[i]] = std::move(pictures[i]);
  }
  return earlier;
}

void KeptTargets::keep(const BatchLayout& layout, const std::vector<BakedPicture>& pictures, bool in_time) {
  if (!cache_.is_on()) return;
  std::vector<std::pair<std::size_t, TargetPictures>> complete;
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const std::size_t rect = layout.rects[i], target = plan_.rects[rect].target;
      parts_[target][rect] = pictures[i];
    }
    for (auto it = parts_.begin(); it != parts_.end();) {
      const std::vector<std::size_t> rects = targets_[it->first].rects();
      const auto is_there = [&](std::size_t rect) { return it->second.contains(rect); };
      if (!std::ranges::all_of(rects, is_there)) {
        ++it;
        continue;
      }
      TargetPictures all;
      for (const std::size_t rect : rects) all.push_back(std::move(it->second[rect]));
      complete.emplace_back(it->first, std::move(all));
      it = parts_.erase(it);
    }
  }
  for (const auto& [target, all] : complete) {
    const int samples = in_time ? all.front().all_samples() : targets_[target].samples();
    cache_.keep_target(keys_[target], all, samples);
  }
}

void KeptTargets::forget_journal() const {
  if (cache_.is_on()) cache_.forget(run_);
}

}  // namespace rnmbake
