// bench/planning.cpp - seconds of each step between a survey and the arrays that Blender gets.
//
// bench_planning SURVEY.json FOLDER [REPEATS] prints one JSON object; the receivers' arrays go to FOLDER.
#include "bake/plan.h"
#include "bake/request.h"
#include "base/error.h"
#include "encoding/basis_set.h"
#include "scene/surface.h"
#include "scene/survey_parse.h"
#include "scene/uv_report.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <numeric>
#include <string>

namespace rnmbake {
namespace {

constexpr int side = 64;  // texels

/// Seconds by step; of several repeats the fastest counts, which is the one that nothing disturbed.
class Laps {
 public:
  void start() {
    total_.clear();
    last_ = std::chrono::steady_clock::now();
  }
  void lap(const std::string& step) {
    const auto now = std::chrono::steady_clock::now();
    total_[step] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
  void finish() {
    for (const auto& [step, seconds] : total_) {
      const auto [best, is_new] = best_.try_emplace(step, seconds);
      if (!is_new) best->second = std::min(best->second, seconds);
    }
  }
  [[nodiscard]] const std::map<std::string, double>& best() const { return best_; }

 private:
  std::chrono::steady_clock::time_point last_;
  std::map<std::string, double> total_, best_;
};

/// The layer for textures; each triangle over the whole square where the object has none.
Uvs uvs_of(const Mesh& mesh) {
  if (!mesh.uv_layers.empty()) {
    return std::make_shared<const std::vector<Vec2>>(
        mesh.uv_layers[static_cast<std::size_t>(std::max(mesh.render_uv, 0))].uv);
  }
  std::vector<Vec2> uv(mesh.loop_vertex.size());
  for (std::size_t loop = 0; loop < uv.size(); ++loop) uv[loop] = Vec2(loop % 3 == 1, loop % 3 == 2);
  return std::make_shared<const std::vector<Vec2>>(std::move(uv));
}

std::vector<Target> targets_of(const SceneSurvey& survey) {
  std::vector<Target> targets;
  for (std::size_t i = 0; i < survey.objects.size(); ++i) {
    const Mesh& mesh = survey.mesh_of(survey.objects[i]);
    if (mesh.triangles() == 0) continue;
    Target target;
    target.object = i;
    target.key = survey.objects[i].key;
    target.part.triangles.resize(mesh.triangles());
    std::iota(target.part.triangles.begin(), target.part.triangles.end(), 0);
    target.uv = target.tangent_uv = uvs_of(mesh);
    target.width = target.height = side;
    targets.push_back(std::move(target));
  }
  return targets;
}

/// Returns the number of receiver triangles.
std::size_t plan_once(const std::filesystem::path& survey_file, const std::filesystem::path& folder,
                      Laps& laps) {
  laps.start();
  const SceneSurvey survey = read_survey(survey_file);
  laps.lap("read survey");
  const std::vector<Target> targets = targets_of(survey);
  const std::vector<BasisDirection> bases = flat_and_rnm().directions;
  Plan plan;
  laps.lap("targets");
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Target& target = targets[i];
    const SceneObject& object = survey.objects[target.object];
    const Mesh& mesh = survey.mesh_of(object);
    const TangentFrames frames = tangent_frames(mesh, *target.tangent_uv, object.to_world);
    laps.lap("tangent frames");
    const Surface surface = make_surface(mesh, target.part.triangles, *target.uv, frames, object.to_world);
    laps.lap("surface");
    ReceiverPasses passes =
        make_receiver_passes(surface, bases, ObjectSettings::Horizon::identity, Vec2(side));
    laps.lap("receiver passes");
    add_receiver_tasks(plan, plan_target(survey, target), std::move(passes), task_names(bases), {});
    laps.lap("crop");
  }
  group_tasks(plan, BakingSettings::Dispatch::scene);
  laps.lap("group");
  const BakeRequest request = receiver_request(plan, plan.batches.front(), 1 << 24, folder);
  laps.lap("write arrays");
  for (const Target& target : targets) {
    const SceneObject& object = survey.objects[target.object];
    (void)report_uv(survey.mesh_of(object), *target.uv, object.to_world, side, side);
  }
  laps.lap("uv report (inspect only)");
  laps.finish();
  std::size_t corners = 0;
  for (const AtlasRect& rect : plan.rects) corners += rect.pass.corners.size();
  return corners / 3;
}

int run(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: bench_planning SURVEY.json FOLDER [REPEATS]\n";
    return static_cast<int>(ExitCode::usage);
  }
  const int repeats = argc > 3 ? std::stoi(argv[3]) : 5;
  Laps laps;
  std::size_t triangles = 0;
  for (int i = 0; i < repeats; ++i) triangles = plan_once(argv[1], argv[2], laps);
  std::cout << nlohmann::json{{"steps", laps.best()}, {"triangles", triangles}}.dump() << "\n";
  return 0;
}

}  // namespace
}  // namespace rnmbake

int main(int argc, char** argv) {
  try {
    return rnmbake::run(argc, argv);
  } catch (const rnmbake::Error& error) {
    std::cerr << "bench_planning: " << error.what() << "\n";
    return static_cast<int>(error.code());
  }
}
