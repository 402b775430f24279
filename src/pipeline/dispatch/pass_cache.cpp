#include "pipeline/dispatch/pass_cache.h"

#include "base/hash.h"
#include "base/json.h"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <utility>

namespace rnmbake {
namespace {

using nlohmann::json;

template <typename T>
std::string hash_of(const std::vector<T>& values) {
  return hash128_hex({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

void add_cycles(KeyMaker& key, const CyclesSettings& cycles) {
  json settings = to_json(cycles);
  settings.erase("samples");
  key.add("cycles", settings.dump()).add("noise", cycles.noise);
}

void add_rect(KeyMaker& key, const AtlasRect& rect) {
  key.add("role", std::int64_t(rect.pass.role)).add("basis", std::int64_t(rect.pass.basis));
  key.add("x", std::int64_t{rect.x}).add("y", std::int64_t{rect.y});
  key.add("width", std::int64_t{rect.size.width}).add("height", std::int64_t{rect.size.height});
  key.add("corners", hash_of(rect.pass.corners)).add("mirrors", hash_of(rect.pass.mirrors));
}

ResultKey list_of_samples(const ResultKey& key) {
  return KeyMaker().add("target", key).make("samples");
}

}  // namespace

int PlannedTarget::samples() const {
  return tasks.empty() ? 0 : plan.tasks[tasks.front()].cycles.samples;
}

std::vector<std::size_t> PlannedTarget::rects() const {
  std::vector<std::size_t> all;
  for (const std::size_t task : tasks)
    all.insert(all.end(), plan.tasks[task].rects.begin(), plan.tasks[task].rects.end());
  return all;
}

std::vector<PlannedTarget> planned_targets(const Plan& plan) {
  std::vector<PlannedTarget> targets;
  for (std::size_t i = 0; i < plan.targets.size(); ++i) targets.push_back({plan, i, {}});
  for (std::size_t task = 0; task < plan.tasks.size(); ++task)
    targets[plan.tasks[task].target].tasks.push_back(task);
  return targets;
}

ResultKey PassCache::key_of(const BakeRequest& request, const std::filesystem::path& folder) const {
  KeyMaker key;
  key.add("scene", scene_);
  json settings = request.json;
  settings["cycles"].erase("samples");
  key.add("request", settings.dump());
  const auto add_file = [&](const json& name) {
    key.add("array", file_hash128_hex(folder / name.get<std::string>()));
  };
  for (const json& atlas : settings.value("atlases", json::array())) add_file(atlas.at("arrays"));
  if (settings.contains("guards") && settings["guards"]["fences"]["count"] != 0)
    add_file(settings["guards"]["fences"]["arrays"]);
  for (const json& target : settings.value("targets", json::array())) {
    for (const char* array : {"uv_array", "polygons"}) {
      if (target.contains(array)) add_file(target.at(array));
    }
  }
  return key.make("request");
}

ResultKey PassCache::key_of(const ResultKey& request, const SamplePass& pass, int seed,
                            const std::vector<std::size_t>& left_out) {
  KeyMaker key;
  key.add("request", request).add("seed", std::int64_t{seed_of_half(seed, pass.half)});
  key.add("first", std::int64_t{pass.first}).add("count", std::int64_t{pass.count});
  key.add("of", std::int64_t{pass.of}).add("left out", hash_of(left_out));
  return key.make("pass");
}

ResultKey PassCache::key_of(const PlannedTarget& target) const {
  const Plan& plan = target.plan;
  const PlanTarget& of = plan.targets[target.target];
  KeyMaker key;
  key.add("scene", scene_).add("light group", of.light_group).add("content", of.content);
  key.add("width", std::int64_t{of.map.width}).add("height", std::int64_t{of.map.height});
  for (const std::string& absent : plan.absent) key.add("absent", absent);
  if (plan.guards) {
    key.add("glow", json(plan.guards->glow_heights).dump());
    if (!plan.guards->fences.empty()) key.add("fences", hash_of(plan.guards->fences[target.target]));
  }
  for (const std::size_t task : target.tasks) {
    add_cycles(key, plan.tasks[task].cycles);
    for (const std::size_t rect : plan.tasks[task].rects) add_rect(key, plan.rects[rect]);
  }
  return key.make("target");
}

ResultKey PassCache::key_of(const ResultKey& target, int samples) {
  return KeyMaker().add("target", target).add("samples", std::int64_t{samples}).make("target");
}

std::optional<std::vector<BakedPicture>> PassCache::find(const ResultKey& key, std::size_t pictures) const {
  if (!is_on()) return std::nullopt;
  const auto bytes = store_->get(key);
  auto found = bytes ? from_bytes(*bytes) : std::nullopt;
  if (found && found->size() != pictures) return std::nullopt;
  return found;
}

void PassCache::keep(const ResultKey& key, const std::vector<BakedPicture>& pictures) const {
  if (is_on()) store_->put(key, to_bytes(pictures));
}

void PassCache::forget(const ResultKey& key) const {
  if (is_on()) store_->remove(key);
}

std::vector<int> PassCache::samples_kept(const ResultKey& key) const {
  std::vector<int> kept;
  std::istringstream in(store_->get(list_of_samples(key)).value_or(""));
  for (int samples = 0; in >> samples;) kept.push_back(samples);
  return kept;
}

std::optional<TargetPictures> PassCache::find_part(const ResultKey& target, int wanted,
                                                   std::size_t pictures) const {
  if (!is_on()) return std::nullopt;
  std::vector<int> kept = samples_kept(target);
  std::ranges::sort(kept, std::greater());
  for (const int samples : kept) {
    if (samples >= wanted) continue;
    if (auto found = find(key_of(target, samples), pictures)) return found;
  }
  return std::nullopt;
}

void PassCache::keep_target(const ResultKey& target, const TargetPictures& pictures, int samples) const {
  if (!is_on()) return;
  keep(key_of(target, samples), pictures);
  std::vector<int> kept = samples_kept(target);
  if (std::ranges::find(kept, samples) != kept.end()) return;
  kept.push_back(samples);
  std::string list;
  for (const int one : kept) list += std::to_string(one) + " ";
  store_->remove(list_of_samples(target));
  store_->put(list_of_samples(target), list);
}

std::optional<PassCache::Missing> PassCache::find_journal(const ResultKey& run) const {
  if (!is_on()) return std::nullopt;
  const auto text = store_->get(run);
  if (!text) return std::nullopt;
  Missing missing;
  std::istringstream in(*text);
  std::size_t target = 0;
  for (HalfSamples samples{}; in >> target >> samples[0] >> samples[1];) missing[target] = samples;
  return missing;
}

void PassCache::keep_journal(const ResultKey& run, const Missing& missing) const {
  if (!is_on()) return;
  std::string text;
  for (const auto& [target, samples] : missing)
    text +=
        std::to_string(target) + " " + std::to_string(samples[0]) + " " + std::to_string(samples[1]) + "\n";
  store_->put(run, text);
}

}  // namespace rnmbake
