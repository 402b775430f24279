#include "pipeline/farm/batch_file.h"

#include "bake/request.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/read_file.h"

#include <cstring>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

static_assert(std::is_standard_layout_v<ReceiverCorner> && sizeof(ReceiverCorner) == 32);
static_assert(std::is_standard_layout_v<Fence> && sizeof(Fence) == 60);

template <typename T>
void append(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// Hands out values of a file one list after the other.
class ValueFile {
 public:
  ValueFile(fs::path file) : file_(std::move(file)), bytes_(read_data(file_)) {}

  template <typename T>
  std::vector<T> take(std::size_t count) {
    if (count > (bytes_.size() - at_) / sizeof(T))
      fail(ExitCode::invalid_input, "{} is cut off; submit again", file_.string());
    std::vector<T> values(count);
    if (count > 0) std::memcpy(static_cast<void*>(values.data()), bytes_.data() + at_, count * sizeof(T));
    at_ += count * sizeof(T);
    return values;
  }

 private:
  fs::path file_;
  std::string bytes_;
  std::size_t at_ = 0;
};

CyclesSettings cycles_of(const json& text) {
  CyclesSettings cycles;
  cycles.samples = text.at("samples");
  cycles.bounces = text.at("bounces");
  cycles.seed = text.at("seed");
  cycles.clamp = text.at("clamp");
  cycles.device = text.at("device");
  cycles.lamps = text.at("lamps");
  cycles.mirrors = text.at("mirrors");
  return cycles;
}

json target_json(const PlanTarget& target, std::size_t fences) {
  return {{"key", target.key},
          {"width", target.map.width},
          {"height", target.map.height},
          {"light_group", target.light_group},
          {"fences", fences}};
}

json rect_json(const AtlasRect& rect, std::size_t target) {
  return {{"target", target},
          {"role", int(rect.pass.role)},
          {"basis", rect.pass.basis},
          {"x", rect.x},
          {"y", rect.y},
          {"width", rect.size.width},
          {"height", rect.size.height},
          {"corners", rect.pass.corners.size()},
          {"mirrors", rect.pass.mirrors.size()},
          {"meets_light", rect.pass.meets_light}};
}

AtlasRect rect_of(const json& text, std::size_t first_target, ValueFile& corners, ValueFile& mirrors) {
  AtlasRect rect;
  rect.target = first_target + text.at("target").get<std::size_t>();
  rect.pass.role = ReceiverPass::Role(text.at("role").get<int>());
  rect.pass.basis = text.at("basis");
  rect.x = text.at("x");
  rect.y = text.at("y");
  rect.size = {text.at("width"), text.at("height")};
  rect.pass.corners = corners.take<ReceiverCorner>(text.at("corners"));
  rect.pass.meets_light = text.at("meets_light");
  rect.pass.mirrors = mirrors.take<Mirror>(text.at("mirrors"));
  return rect;
}

/// Adds what a folder holds behind what is there.
void add_batch(Plan& plan, const json& text, const fs::path& folder) {
  ValueFile corners(folder / "corners.f32"), mirrors(folder / "mirrors.f32"), fences(folder / "fences.f32");
  const std::size_t first_target = plan.targets.size(), first_rect = plan.rects.size();
  for (const json& target : text.at("targets")) {
    plan.targets.push_back(
        {target.at("key"), {target.at("width"), target.at("height")}, target.at("light_group")});
    if (plan.guards) plan.guards->fences.push_back(fences.take<Fence>(target.at("fences")));
  }
  for (const json& rect : text.at("rects"))
    plan.rects.push_back(rect_of(rect, first_target, corners, mirrors));
  Batch batch;
  for (const json& one : text.at("tasks")) {
    BakeTask task;
    task.target = first_target + one.at("target").get<std::size_t>();
    task.name = one.at("name");
    task.basis = one.at("basis");
    for (const json& rect : one.at("rects")) task.rects.push_back(first_rect + rect.get<std::size_t>());
    task.cycles = cycles_of(text.at("cycles"));
    const bool is_there = task.target < plan.targets.size() && task.rects.size() <= plan.rects.size();
    if (!is_there) fail(ExitCode::invalid_input, "{}: names no target of its own", folder.string());
    batch.tasks.push_back(plan.tasks.size());
    plan.tasks.push_back(std::move(task));
  }
  plan.batches.push_back(std::move(batch));
}

}  // namespace

void write_batch(const Plan& plan, const Batch& batch, const fs::path& folder) {
  make_folders(folder);
  std::map<std::size_t, std::size_t> targets;  // of the plan -> of the file, in their order
  for (const std::size_t task : batch.tasks) targets[plan.tasks[task].target] = 0;
  json targets_json = json::array(), rects = json::array(), tasks = json::array();
  std::string corners, mirrors, fences;
  const bool has_fences = plan.guards && !plan.guards->fences.empty();
  for (auto& [target, place] : targets) {
    place = targets_json.size();
    const std::vector<Fence> of_target = has_fences ? plan.guards->fences[target] : std::vector<Fence>{};
    targets_json.push_back(target_json(plan.targets[target], of_target.size()));
    append(fences, of_target);
  }
  for (const std::size_t index : batch.tasks) {
    const BakeTask& task = plan.tasks[index];
    std::vector<std::size_t> own;
    for (const std::size_t rect : task.rects) {
      own.push_back(rects.size());
      rects.push_back(rect_json(plan.rects[rect], targets.at(plan.rects[rect].target)));
      append(corners, plan.rects[rect].pass.corners);
      append(mirrors, plan.rects[rect].pass.mirrors);
    }
    tasks.push_back(
        {{"target", targets.at(task.target)}, {"name", task.name}, {"basis", task.basis}, {"rects", own}});
  }
  json text{{"cycles", to_json(plan.tasks[batch.tasks.front()].cycles)},
            {"absent", plan.absent},
            {"glow_heights", nullptr},
            {"targets", targets_json},
            {"rects", rects},
            {"tasks", tasks}};
  if (plan.guards) text["glow_heights"] = plan.guards->glow_heights;
  write_atomically(folder / "corners.f32", corners);
  write_atomically(folder / "mirrors.f32", mirrors);
  write_atomically(folder / "fences.f32", fences);
  write_atomically(folder / "batch.json", text.dump() + "\n");
}

Plan read_batches(const std::vector<fs::path>& folders) {
  Plan plan;
  for (const fs::path& folder : folders) {
    const std::string name = (folder / "batch.json").string();
    const json text = parse_json(read_text(folder / "batch.json"), name);
    try {
      plan.absent = text.at("absent").get<std::vector<std::string>>();
      if (!text.at("glow_heights").is_null() && !plan.guards)
        plan.guards.emplace().glow_heights = text.at("glow_heights").get<GlowHeights>();
      add_batch(plan, text, folder);
    } catch (const json::exception& problem) {
      fail(ExitCode::invalid_input, "{}: {}; submit again", name, brief(problem));
    }
  }
  return plan;
}

}  // namespace rnmbake
