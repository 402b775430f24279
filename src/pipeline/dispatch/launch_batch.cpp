#include "pipeline/dispatch/launch_batch.h"

#include "base/error.h"
#include "base/log.h"
#include "pipeline/scene/scene_survey.h"

namespace rnmbake {
namespace {

/// Pictures that are not whole count as missing: a smaller launch may succeed.
void take_finished(BatchWork& work, bool keep_files) {
  try {
    work.take_finished(keep_files);
  } catch (const Error& error) {
    if (error.code() != ExitCode::tasks_failed) throw;
    log::debug("{}", error.what());
  }
}

}  // namespace

LaunchOutcome launch_batch(BlenderSession& session, const BlendPath& blend, int jobs, BatchWork& work,
                           const std::function<void(const ProgressEvent&)>& on_progress) {
  Launch launch;
  launch.entry = "bake_entry.py";
  launch.scene = blend;
  launch.folder = work.folder();
  launch.threads = session.threads(jobs);
  launch.request = work.launch_request();
  launch.request.update(scene_request(session, blend.path()));
  const bool keep_files = session.settings().output.keep_temporary;
  LaunchOutcome outcome = session.blender().run(launch, session.limits(), [&](const ProgressEvent& event) {
    take_finished(work, keep_files);
    on_progress(event);
  });
  take_finished(work, keep_files);
  return outcome;
}

LaunchFailure no_picture(const BatchWork& work, const Plan& plan) {
  LaunchFailure failure;
  failure.message = "Blender ended before the last pass";
  try {
    (void)read_rects(work.layout(), plan, work.folder(), work.passes_done());
  } catch (const Error& error) {
    failure.message = error.what();
  }
  return failure;
}

PassCost cost_of(const Plan& plan, const BatchLayout& layout, std::int64_t scene_triangles) {
  std::int64_t triangles = 0;
  for (const std::size_t rect : layout.rects)
    triangles += static_cast<std::int64_t>(plan.rects[rect].pass.triangles());
  return model_cost(texels_of(plan, layout.rects), triangles, scene_triangles);
}

}  // namespace rnmbake
