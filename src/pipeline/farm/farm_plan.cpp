#include "pipeline/farm/farm_plan.h"

#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/version.h"
#include "pipeline/run/result_store.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int farm_schema = 2;

constexpr std::array<std::string_view, 18> needed_by_launches{
    "scene",        "view_layer",  "frame",          "allow_scripts", "materials", "atlas_limit",
    "memory_limit", "blender",     "scripts",        "timeout",       "threads",   "retries",
    "cache",        "cache_limit", "launch_timeout", "jobs",          "sky",       "sun"};

json pass_json(const FarmPass& pass) {
  const SamplePass& of = pass.samples;
  return {{"half", of.half}, {"first", of.first},      {"count", of.count},
          {"of", of.of},     {"key", pass.key.digits}, {"seconds", pass.seconds}};
}

FarmPass pass_of(const json& pass) {
  return {{pass.at("half"), pass.at("first"), pass.at("count"), pass.at("of")},
          {"pass", pass.at("key")},
          pass.at("seconds")};
}

fs::path passes_file(const FarmPlan& plan, std::size_t batch) {
  return plan.batch_folder(batch) / "passes.json";
}

void write_passes(const FarmPlan& plan, std::size_t batch) {
  json passes = json::array();
  for (const FarmPass& pass : plan.batches[batch].passes) passes.push_back(pass_json(pass));
  make_folders(plan.batch_folder(batch));
  write_atomically(passes_file(plan, batch), passes.dump() + "\n");
}

json task_json(const FarmTask& task) {
  json shares = json::array();
  for (const FarmShare& share : task.shares)
    shares.push_back({{"batch", share.batch}, {"first", share.first}, {"count", share.count}});
  return {{"seconds", task.seconds}, {"shares", shares}};
}

/// Throws Error(invalid_input) where a share names a batch that is not there.
FarmTask task_of(const json& task, const std::vector<FarmBatch>& batches) {
  FarmTask result{{}, task.at("seconds")};
  for (const json& share : task.at("shares")) {
    const FarmShare one{share.at("batch"), share.at("first"), share.at("count")};
    if (one.batch >= batches.size())
      fail(ExitCode::invalid_input, "plan.json names a batch that it does not list; submit again");
    result.shares.push_back(one);
  }
  return result;
}

json input_json(const RunFile& file) {
  return {{"kind", file.kind},
          {"path", file.path.string()},
          {"size", file.size},
          {"time", file.time},
          {"hash", file.hash}};
}

FarmPlan plan_of(const json& text, const fs::path& folder) {
  if (text.at("schema_version") != farm_schema || text.at("rnmbake") != version)
    fail(ExitCode::invalid_input, "{} was written by rnmbake {}, this is {}; submit again, or run that one",
         (folder / "plan.json").string(), brief(text.at("rnmbake")), version);
  FarmPlan plan;
  plan.folder = folder;
  plan.id = text.at("id");
  const json& blender = text.at("blender");
  plan.blender = {blender.at("version"), blender.at("build"), blender.at("scripts")};
  plan.scene = folder / text.at("scene").get<std::string>();  // an absolute path stays what it is
  plan.scene_key = {"scene", text.at("scene_key")};
  plan.scene_triangles = text.at("scene_triangles");
  plan.output = text.at("output").get<std::string>();
  plan.jobs = text.at("jobs");
  plan.settings = text.at("settings");
  plan.work_folder = text.at("merge").at("folder").get<std::string>();
  plan.merge = text.at("merge").at("arguments").get<std::vector<std::string>>();
  for (const json& file : text.at("inputs"))
    plan.inputs.push_back({file.at("kind"), file.at("path").get<std::string>(), file.at("size"),
                           file.at("time"), file.at("hash")});
  for (const json& batch : text.at("batches"))
    plan.batches.push_back({batch.at("objects").get<std::vector<std::string>>(), {}});
  for (const json& task : text.at("tasks")) plan.tasks.push_back(task_of(task, plan.batches));
  return plan;
}

}  // namespace

fs::path FarmPlan::batch_folder(std::size_t batch) const {
  return folder / "batches" / fmt::format("{:05}", batch);
}

ResultKey FarmPlan::probe_key() const {
  return KeyMaker().add("plan", id).make("probe");
}

fs::path usual_plan_folder(const fs::path& output) {
  return output / ".rnmbake-plan";
}

void write_farm_plan(const FarmPlan& plan) {
  const fs::path inside = plan.scene.lexically_relative(plan.folder);
  const bool is_inside = !inside.empty() && *inside.begin() != "..";
  json inputs = json::array(), batches = json::array(), tasks = json::array();
  for (const RunFile& file : plan.inputs) inputs.push_back(input_json(file));
  for (std::size_t batch = 0; batch < plan.batches.size(); ++batch) {
    write_passes(plan, batch);
    batches.push_back({{"objects", plan.batches[batch].objects}});
  }
  for (const FarmTask& task : plan.tasks) tasks.push_back(task_json(task));
  const FarmBlender& blender = plan.blender;
  const json text{
      {"schema_version", farm_schema},
      {"rnmbake", version},
      {"id", plan.id},
      {"blender", {{"version", blender.version}, {"build", blender.build}, {"scripts", blender.scripts}}},
      {"scene", (is_inside ? inside : plan.scene).string()},
      {"scene_key", plan.scene_key.digits},
      {"scene_triangles", plan.scene_triangles},
      {"output", plan.output.string()},
      {"jobs", plan.jobs},
      {"settings", plan.settings},
      {"merge", {{"folder", plan.work_folder.string()}, {"arguments", plan.merge}}},
      {"inputs", inputs},
      {"batches", batches},
      {"tasks", tasks},
  };
  write_atomically(plan.folder / "plan.json", text.dump(1) + "\n");
}

FarmPlan read_farm_plan(const fs::path& folder) {
  fs::path place = fs::absolute(folder).lexically_normal();
  if (!fs::exists(place / "plan.json") && fs::exists(usual_plan_folder(place) / "plan.json"))
    place = usual_plan_folder(place);
  const fs::path file = place / "plan.json";
  if (!fs::exists(file))
    fail(ExitCode::io, "{}: holds no plan; make one with rnmbake submit, in a folder that all machines see",
         folder.string());
  const json text = parse_json(read_text(file), file.string());
  try {
    return plan_of(text, place);
  } catch (const json::exception& problem) {
    fail(ExitCode::invalid_input, "{}: {}; submit again", file.string(), brief(problem));
  }
}

PassesByBatch read_passes(const FarmPlan& plan, const FarmTask& task) {
  PassesByBatch all;
  for (const FarmShare& share : task.shares) {
    const std::string file = passes_file(plan, share.batch).string();
    std::vector<FarmPass>& passes = all[share.batch];
    try {
      if (passes.empty()) {
        for (const json& pass : parse_json(read_text(file), file)) passes.push_back(pass_of(pass));
      }
    } catch (const json::exception& problem) {
      fail(ExitCode::invalid_input, "{}: {}; submit again", file, brief(problem));
    }
    if (share.count > passes.size() || share.first > passes.size() - share.count)
      fail(ExitCode::invalid_input, "{} lacks passes that plan.json names; submit again", file);
  }
  return all;
}

json launch_settings(const ResolvedConfig& config) {
  json settings = json::object();
  for (const std::string_view key : needed_by_launches) {
    const Setting& setting = *find_setting(key);
    SettingValue value = setting.slot.get(config.globals);
    auto* text = std::get_if<std::string>(&value);
    const bool is_path = setting.kind == SettingKind::path ||
                         (setting.kind == SettingKind::program && text->find('/') != std::string::npos);
    if (is_path && !text->empty()) *text = fs::absolute(*text).lexically_normal().string();
    std::visit([&](const auto& one) { settings[std::string(key)] = one; }, value);
  }
  settings["cache"] = cache_folder(config.globals.run.cache).string();
  return settings;
}

ResolvedConfig node_config(const FarmPlan& plan, const NodeSettings& node) {
  std::vector<SettingOverride> values;
  const auto set = [&](const std::string& key, SettingValue value) {
    values.push_back({find_setting(key), std::move(value), SettingSource::flag, "plan.json"});
  };
  for (const std::string_view key : needed_by_launches) {
    const json& value = plan.settings.at(std::string(key));
    if (value.is_boolean()) set(std::string(key), value.get<bool>());
    if (value.is_number_integer()) set(std::string(key), value.get<std::int64_t>());
    if (value.is_number_float()) set(std::string(key), value.get<double>());
    if (value.is_string()) set(std::string(key), value.get<std::string>());
  }
  set("file", plan.scene.string());
  set("jobs", std::int64_t{1});
  if (!node.blender.empty()) set("blender", node.blender);
  if (node.threads > 0) set("threads", std::int64_t{node.threads});
  if (node.keep_temporary) set("keep_temporary", true);
  return resolve({}, {}, values);
}

}  // namespace rnmbake
