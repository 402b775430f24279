// tests/pipeline/fixture.h - a plan over invented objects and a Blender that fails on demand.
#pragma once

#include "base/files.h"
#include "blender/blender_session.h"
#include "blender/launch.h"
#include "config/resolve.h"
#include "pipeline/dispatch/dispatcher.h"
#include "pipeline/lightmaps/bake_collector.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {

/// What a launch bakes: pairs of target and basis.
using Baked = std::set<std::pair<std::size_t, std::size_t>>;

/// Stands in for crashes, hangs and kills that a real Blender cannot be asked for. What it is not told to
/// fail it bakes to grey. Receivers tell it what they are by their position (x: target, y: basis).
class FakeBlender : public Blender {
 public:
  /// Decides how a launch ends; nothing: well.
  std::function<std::optional<LaunchFailure>(const Baked&)> fault = [](const Baked&) { return std::nullopt; };
  /// Decides after each pass whether the launch goes on; nothing: it does.
  std::function<std::optional<LaunchFailure>(const nlohmann::json& pass)> fault_after =
      [](const nlohmann::json&) { return std::nullopt; };
  bool short_pictures = false;
  std::vector<Baked> launches;
  std::vector<nlohmann::json> passes;    // of all launches
  std::vector<nlohmann::json> left_out;  // of rounds that leave something out
  double noise = 0;  // standard deviation of one sample; twice that in the atlas's right half

  [[nodiscard]] const BlenderInfo& info() const override { return info_; }

  LaunchOutcome run(const Launch& launch, const LaunchLimits& /*limits*/,
                    const std::function<void(const ProgressEvent&)>& on_progress) override {
    const Baked baked = contents(launch);
    {
      const std::lock_guard lock(mutex_);
      launches.push_back(baked);
    }
    on_progress({"bake", "atlas 1", 1, 2, 0, 0, ""});
    if (auto failure = fault(baked)) return *failure;
    nlohmann::json known = launch.request.at("passes");
    while (!known.empty()) {
      for (const auto& pass : known) {
        const auto& atlases = launch.request.at("atlases");
        for (std::size_t i = 0; i < atlases.size(); ++i)
          write_pixels(launch.folder / pass.at("pixels").at(i).get<std::string>(), atlases.at(i), pass);
        {
          const std::lock_guard lock(mutex_);
          passes.push_back(pass);
        }
        on_progress({"bake", "pass", 1, 2, 0, 0, ""});
        if (auto failure = fault_after(pass)) return *failure;
      }
      if (!launch.request.at("by_rounds")) break;
      const std::size_t next = known.back().at("number").get<std::size_t>() + 1;
      std::ifstream go(launch.folder / ("go" + std::to_string(next) + ".json"));
      const nlohmann::json more = nlohmann::json::parse(go);
      if (!more.at("left_out").empty()) left_out.push_back(more.at("left_out"));
      known = more.at("passes");
    }
    Finished finished;
    finished.result = {
        {"atlases", {{{"prepare_seconds", 0.25}, {"bake_seconds", 0.5}, {"save_seconds", 0.125}}}}};
    finished.wall_seconds = 1;
    finished.peak_bytes = 1000 * baked.size();
    return finished;
  }

 private:
  static Baked contents(const Launch& launch) {
    Baked baked;
    for (const auto& atlas : launch.request.at("atlases")) {
      std::ifstream in(launch.folder / atlas.at("arrays").get<std::string>(), std::ios::binary);
      for (const auto& group : atlas.at("groups")) {
        std::vector<float> values(group.at("corners").get<std::size_t>() * 8);
        in.read(reinterpret_cast<char*>(values.data()), std::streamsize(values.size() * sizeof(float)));
        for (std::size_t i = 0; i < values.size() / 8 * 3; i += 3)
          baked.emplace(std::size_t(values[i]), std::size_t(values[i + 1]));
      }
    }
    return baked;
  }

  void write_pixels(const std::filesystem::path& file, const nlohmann::json& atlas,
                    const nlohmann::json& pass) const {
    const std::size_t count = atlas.at("width").get<std::size_t>() * atlas.at("height").get<std::size_t>();
    std::vector<float> pixels(4 * count, 0.5F);
    const auto width = atlas.at("width").get<std::size_t>();
    std::mt19937 random(pass.at("seed").get<unsigned>() + 7919 * pass.at("first").get<unsigned>());
    std::normal_distribution<double> normal(0, noise / std::sqrt(pass.at("count").get<double>()));
    for (std::size_t i = 0; i < pixels.size() && noise > 0; ++i)
      pixels[i] += float(normal(random) * (i / 4 % width < width / 2 ? 1 : 2));
    for (std::size_t i = 3; i < pixels.size(); i += 4) pixels[i] = 1;
    if (short_pictures) pixels.pop_back();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(pixels.data()), std::streamsize(pixels.size() * sizeof(float)));
  }

  BlenderInfo info_;
  std::mutex mutex_;
};

inline LaunchFailure failure(LaunchFailure::Kind kind, const std::string& message, int code = 0) {
  LaunchFailure result;
  result.kind = kind;
  result.message = message;
  result.code = code;
  return result;
}

/// `count` objects named object0, object1, ... whose only face fills an 8 x 8 map, baked for four bases.
class Invented {
 public:
  explicit Invented(std::size_t count, const BakeSettings& settings = {}) : config_(make_config(settings)) {
    config_.globals.output.dir = folder_.path();
    bases_ = flat_and_rnm().directions;
    survey_.meshes.emplace_back();
    for (std::size_t i = 0; i < count; ++i) add_object(i);
    group_tasks(plan_, config_.globals.bake.dispatch);
  }

  [[nodiscard]] BakeContext context() const { return {survey_, targets_, bases_, plan_}; }
  [[nodiscard]] const ResolvedConfig& config() const { return config_; }
  [[nodiscard]] BakeSettings& settings() { return config_.globals; }
  [[nodiscard]] const Plan& plan() const { return plan_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  [[nodiscard]] std::vector<LightmapHeader>& headers() { return headers_; }

  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  static ResolvedConfig make_config(const BakeSettings& settings) {
    ResolvedConfig config = resolve({}, {}, {});
    config.globals = settings;
    if (settings.bake.dispatch == BakingSettings::Dispatch::automatic)
      config.globals.bake.dispatch = BakingSettings::Dispatch::scene;
    return config;
  }

  void add_object(std::size_t index) {
    const std::string name = "object" + std::to_string(index);
    SceneObject object;
    object.key = object.name = name;
    object.mesh = 0;
    survey_.objects.push_back(object);
    Target target;
    target.object = index;
    target.key = name;
    target.width = target.height = 8;
    ReceiverPasses passes;
    for (std::size_t b = 0; b < bases_.size(); ++b) {
      const Vec3 id(static_cast<float>(index), static_cast<float>(b), 0), up(0, 0, 1);
      passes.passes.push_back(
          {ReceiverPass::Role::basis, b, {{id, up, {0, 0}}, {id, up, {1, 0}}, {id, up, {1, 1}}}});
    }
    add_receiver_tasks(plan_, plan_target(survey_, target), std::move(passes), task_names(bases_), {});
    targets_.push_back(std::move(target));
    LightmapHeader note;
    note.stem = name;
    note.metadata.object = name;
    headers_.push_back(note);
  }

  TempFolder folder_;
  ResolvedConfig config_;
  SceneSurvey survey_;
  std::vector<Target> targets_;
  std::vector<BasisDirection> bases_;
  Plan plan_;
  std::vector<LightmapHeader> headers_;
};

inline bool is_delivered(const BakeCollector& collector, std::size_t target) {
  const Delivery& delivery = collector.deliveries()[target];
  return delivery && std::holds_alternative<Delivered>(*delivery);
}

/// Why a target was given up; "" if it was not.
inline std::string reason_of(const BakeCollector& collector, std::size_t target) {
  const Delivery& delivery = collector.deliveries()[target];
  const auto* given_up = delivery ? std::get_if<NotDelivered>(&*delivery) : nullptr;
  return given_up != nullptr ? given_up->reason : "";
}

}  // namespace rnmbake
