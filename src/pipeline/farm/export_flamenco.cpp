#include "pipeline/farm/export_flamenco.h"

#include "base/files.h"
#include "pipeline/farm/queue_words.h"

#include <string_view>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Flamenco takes a job type's name from its file's. A task that was given to a job does not change any more.
constexpr std::string_view type_name = "rnmbake.flamenco";
constexpr std::string_view job_type =
    R"js(// A job type of Flamenco 3: tasks of a plan that `rnmbake submit` made, and their merge.
// It belongs into the folder "scripts" beside flamenco-manager. PLAN/flamenco.json is a job of it.

const JOB_TYPE = {
    label: "rnmbake",
    settings: [
        { key: "plan", type: "string", subtype: "dir_path", required: true,
          description: "Folder of the plan" },
        { key: "tasks", type: "int32", required: true, description: "Tasks that the plan has" },
        { key: "rnmbake", type: "string", default: "rnmbake", required: true,
          description: "The program, as the workers find it" },
    ]
};

function compileJob(job) {
    const settings = job.settings;
    const merge = author.Task("merge", "blender");
    merge.addCommand(author.Command("exec", {
        exe: settings.rnmbake,
        args: ["task", "merge", "--plan", settings.plan],
    }));
    for (let index = 0; index < settings.tasks; index++) {
        const task = author.Task("bake-" + index, "blender");
        task.addCommand(author.Command("exec", {
            exe: settings.rnmbake,
            args: ["task", "run", "--plan", settings.plan, "--index", String(index)],
        }));
        job.addTask(task);
        merge.addDependency(task);
    }
    job.addTask(merge);
}
)js";

}  // namespace

fs::path export_flamenco(const FarmPlan& plan) {
  const json settings{{"plan", plan.folder.string()}, {"tasks", plan.tasks.size()}, {"rnmbake", "rnmbake"}};
  const json job{{"name", job_name(plan)},
                 {"type", type_name},
                 {"priority", 50},
                 {"submitter_platform", "linux"},
                 {"settings", settings}};
  write_atomically(plan.folder / fmt::format("{}.js", type_name), job_type);
  const fs::path file = plan.folder / "flamenco.json";
  write_atomically(file, job.dump(1) + "\n");
  return file;
}

}  // namespace rnmbake
