#include "pipeline/render/compare_probes.h"

#include "base/error.h"
#include "pipeline/render/view_halves.h"
#include "trace/gbuffer.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace rnmbake {
namespace {

/// 1 where a pixel and all its neighbours have it: a pixel on an object's edge shows what is behind, too.
FloatImage without_edges(const FloatImage& mask) {
  FloatImage inner(mask.width(), mask.height(), 1);
  for (int y = 1; y + 1 < mask.height(); ++y) {
    for (int x = 1; x + 1 < mask.width(); ++x) {
      float least = 1;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) least = std::min(least, mask.texel(x + dx, y + dy)[0]);
      inner.texel(x, y)[0] = least;
    }
  }
  return inner;
}

/// 1 at the pixels that show nothing but objects that the probes light.
FloatImage lit_pixels(const TraceScene& scene, const SceneProbes& probes, const ViewOptions& view) {
  const GBuffer buffer = trace_gbuffer(scene, camera_of(scene.diffuse_scene()), view,
                                       [](const Vertex& vertex) { return vertex.normal; });
  FloatImage lit(buffer.object.width(), buffer.object.height(), 1);
  std::ranges::transform(buffer.object.data(), lit.data().begin(), [&](float number) {
    return number > 0 && probes.lights(static_cast<std::size_t>(number) - 1) ? 1.0F : 0.0F;
  });
  return without_edges(lit);
}

std::string label_of(const ProbeLookup& lookup) {
  const std::string test(leak_test_names[std::size_t(lookup.test)]);
  return std::string(probe_encoding_names[std::size_t(lookup.encoding)]) + " probes (" +
         (lookup.test == LeakTest::none ? "no leak test" : test + " test") + ")";
}

}  // namespace

ViewComparison compare_probes_view(const TraceScene& scene, const SurfaceLights& lights,
                                   const RenderOptions& options) {
  ViewTruth truth = trace_truth(scene, lights, options);
  truth.coverage = lit_pixels(scene, *lights.probes, options.view);
  if (std::ranges::none_of(truth.coverage.data(), [](float lit) { return lit > 0; }))
    fail(ExitCode::invalid_input,
         "the camera sees nothing that the probes light, or less than 3 x 3 pixels of it; move it, pass "
         "--camera fit or --dynamic, or raise --resolution");
  ViewComparison view;
  view.name = camera_of(scene.diffuse_scene()).name;
  view.pictures.push_back({"truth", truth.halves.mean()});
  const std::vector<LeakTest> tests = leak_tests_for(lights.probes->volumes());
  const auto add = [&](const ProbeLookup& lookup) {
    view.pictures.push_back(compared(
        label_of(lookup), looked_up(scene, lights, {Lighting::Kind::probes, {}, lookup}, options), truth));
    view.pictures.back().by_probes = true;
    view.pictures.back().bytes = static_cast<int>(6 * coefficients_of(lookup.encoding));
  };
  for (std::size_t i = 0; i < probe_encoding_names.size(); ++i)
    add({static_cast<ProbeEncoding>(i), tests.back()});
  for (const LeakTest test : tests)
    if (test != tests.back()) add({ProbeEncoding::sh3, test});
  return view;
}

}  // namespace rnmbake
