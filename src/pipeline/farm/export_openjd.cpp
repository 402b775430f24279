#include "pipeline/farm/export_openjd.h"

#include "base/files.h"
#include "base/text.h"
#include "pipeline/farm/queue_words.h"

#include <string>
#include <string_view>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::string_view program = "{{Param.Rnmbake}}";
constexpr std::string_view open_brace = "{{Param.OpenBrace}}", close_brace = "{{Param.CloseBrace}}";
constexpr std::size_t longest_name = 120;  // bytes; 128 characters are allowed

/// Pairs of braces enclose a reference, and nothing but a parameter's value can stand for them.
std::string literal(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '{') result += open_brace;
    if (c == '}') result += close_brace;
    if (c != '{' && c != '}') result += c;
  }
  return result;
}

json parameter(const char* name, const char* value, const char* description) {
  return {{"name", name}, {"type", "STRING"}, {"default", value}, {"description", description}};
}

/// Ends its Blender when it is told to end, for which it gets half a minute.
json step(const char* name, const json& arguments) {
  const json cancelation{{"mode", "NOTIFY_THEN_TERMINATE"}, {"notifyPeriodInSeconds", 30}};
  const json run{{"command", program}, {"args", arguments}, {"cancelation", cancelation}};
  const json linux_only{{"name", "attr.worker.os.family"}, {"anyOf", {"linux"}}};
  return {{"name", name},
          {"hostRequirements", {{"attributes", json::array({linux_only})}}},
          {"script", {{"actions", {{"onRun", run}}}}}};
}

json bake_step(const FarmPlan& plan) {
  json result = step(
      "bake", {"task", "run", "--plan", literal(plan.folder.string()), "--index", "{{Task.Param.Index}}"});
  // An expression, as lists end at 1024 values.
  const json index{{"name", "Index"}, {"type", "INT"}, {"range", fmt::format("0-{}", plan.tasks.size() - 1)}};
  result["parameterSpace"]["taskParameterDefinitions"] = json::array({index});
  return result;
}

json merge_step(const FarmPlan& plan) {
  json result = step("merge", {"task", "merge", "--plan", literal(plan.folder.string())});
  if (!plan.tasks.empty()) result["dependencies"] = json::array({{{"dependsOn", "bake"}}});
  return result;
}

}  // namespace

fs::path export_openjd(const FarmPlan& plan) {
  json steps = json::array();
  if (!plan.tasks.empty()) steps.push_back(bake_step(plan));
  steps.push_back(merge_step(plan));
  json parameters = json::array({parameter("Rnmbake", "rnmbake", "The program, as the workers find it.")});
  parameters.push_back(parameter("OpenBrace", "{", "Stands for itself in paths."));
  parameters.push_back(parameter("CloseBrace", "}", "Stands for itself in paths."));
  const json job{{"specificationVersion", "jobtemplate-2023-09"},
                 {"name", literal(shortened(job_name(plan), longest_name))},
                 {"parameterDefinitions", parameters},
                 {"steps", steps}};
  const fs::path file = plan.folder / "openjd.json";
  write_atomically(file, job.dump(1) + "\n");
  return file;
}

}  // namespace rnmbake
