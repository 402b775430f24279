#include "pipeline/probes/bake_probes.h"

#include "base/error.h"
#include "pipeline/fixture.h"
#include "probes/probe_directions.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

/// Light of a scene in which everything is known: lamps give max(0, n.z), a glowing sky gives 0.25, surfaces
/// send on 0.5 + x/1000, where x is the point's.
double lit(double x, const Vec3& n, bool bounces, bool lamps) {
  return 0.25 + (lamps ? std::max(0.0F, n.z) : 0.0F) + (bounces ? 0.5 + x / 1000 : 0.0);
}

/// Bakes every receiver by lit(), as Blender would: into the texel whose centre it covers.
class LitBlender : public Blender {
 public:
  std::function<bool(double x)> fails = [](double) { return false; };
  std::function<bool(double x)> has_no_number = [](double) { return false; };
  std::vector<nlohmann::json> requests;
  std::size_t failed = 0;

  [[nodiscard]] const BlenderInfo& info() const override { return info_; }

  LaunchOutcome run(const Launch& launch, const LaunchLimits& /*limits*/,
                    const std::function<void(const ProgressEvent&)>& /*on_progress*/) override {
    const std::lock_guard lock(mutex_);
    requests.push_back(launch.request);
    for (const auto& pass : launch.request.at("passes")) {
      const auto& atlases = launch.request.at("atlases");
      for (std::size_t i = 0; i < atlases.size(); ++i) {
        const fs::path file = launch.folder / pass.at("pixels").at(i).get<std::string>();
        if (!bake(launch.folder, launch.request.at("cycles"), atlases.at(i), file)) {
          ++failed;
          return failure(LaunchFailure::Kind::crashed, "Blender crashed (SIGSEGV)");
        }
      }
    }
    return Finished{};
  }

 private:
  /// False where a receiver is one that Blender fails at.
  bool bake(const fs::path& folder, const nlohmann::json& cycles, const nlohmann::json& atlas,
            const fs::path& file) const {
    const std::size_t width = atlas.at("width"), height = atlas.at("height");
    EXPECT_EQ(atlas.at("groups").size(), 1U);
    const std::size_t corners = atlas.at("groups").at(0).at("corners");
    std::vector<float> values(8 * corners), pixels(4 * width * height);
    std::ifstream(folder / atlas.at("arrays").get<std::string>(), std::ios::binary)
        .read(reinterpret_cast<char*>(values.data()), std::streamsize(values.size() * sizeof(float)));
    for (std::size_t k = 0; k < corners; k += 3) {
      const auto centre = [&](std::size_t base, std::size_t stride, std::size_t axis) {
        const auto at = [&](std::size_t n) { return double(values[base + stride * (k + n) + axis]); };
        return 0.25 * at(0) + 0.25 * at(1) + 0.5 * at(2);
      };
      const double x = std::round(centre(0, 3, 0));
      if (fails(x)) return false;
      const float* n = &values[3 * corners + 3 * k];
      const double u = centre(6 * corners, 2, 0) * double(width),
                   v = centre(6 * corners, 2, 1) * double(height);
      float* pixel = &pixels[4 * (std::size_t(v) * width + std::size_t(u))];
      const double value = lit(x, {n[0], n[1], n[2]}, cycles.at("bounces") > 0, cycles.at("lamps"));
      std::fill_n(pixel, 3, has_no_number(x) ? std::numeric_limits<float>::quiet_NaN() : float(value));
      pixel[3] = 1;
    }
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(pixels.data()), std::streamsize(pixels.size() * sizeof(float)));
    return true;
  }

  BlenderInfo info_;
  std::mutex mutex_;
};

/// Probes at x = 0, 1, 2, ... of a scene with a lamp.
struct ProbeRun {
  explicit ProbeRun(std::size_t count, ProbeLights lights = ProbeLights::all) {
    for (std::size_t i = 0; i < count; ++i) positions.emplace_back(double(i), 0, 0);
    wanted.lights = lights;
    survey.lights.emplace_back();
  }

  BakedProbes run() {
    wanted.positions = positions;
    BlenderSession session(config, blender);
    return bake_probes(session, survey, BlendPath("scene.blend"), wanted);
  }

  /// Every value is what lit() says of its position and direction.
  static void expect(const BakedProbes& baked, std::size_t i, bool direct, bool lamps, bool bounced) {
    for (std::size_t d = 0; d < probe_direction_count; ++d) {
      const Vec3& n = probe_directions()[d];
      const double value = (direct ? lit(0, n, false, lamps) : 0) + (bounced ? 0.5 + double(i) / 1000 : 0);
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(baked.irradiance[i * probe_direction_count + d][c], value, 1e-6) << i << ", " << d;
    }
  }

  ResolvedConfig config = resolve({}, {}, {});
  LitBlender blender;
  SceneSurvey survey;
  std::vector<Vec3d> positions;
  ProbeBake wanted{{}, probe_directions(), ProbeLights::all, {}};
};

TEST(BakeProbes, AllDirectionsOfAllPositionsInOneLaunch) {
  ProbeRun bake(2500);
  const BakedProbes baked = bake.run();
  ASSERT_EQ(bake.blender.requests.size(), 1U);
  const auto& request = bake.blender.requests[0];
  ASSERT_EQ(request.at("atlases").size(), 1U);
  EXPECT_EQ(request["atlases"][0].at("groups")[0].at("corners"), 3 * 2500 * 14);
  const double width = request["atlases"][0].at("width"), height = request["atlases"][0].at("height");
  EXPECT_LE(width * height, 1.5 * 2500 * 14);
  EXPECT_LE(std::max(width, height), 2 * std::min(width, height));
  EXPECT_FALSE(request.contains("guards"));
  for (std::size_t i = 0; i < 2500; ++i) {
    EXPECT_TRUE(baked.baked[i]);
    ProbeRun::expect(baked, i, true, true, true);
  }
}

TEST(BakeProbes, LightsAreSumsOfBakes) {
  for (const auto& [lights, launches] : {std::pair{ProbeLights::bounced, 2U}, {ProbeLights::no_lamps, 3U}}) {
    ProbeRun bake(30, lights);
    const BakedProbes baked = bake.run();
    EXPECT_EQ(bake.blender.requests.size(), launches);
    for (std::size_t i = 0; i < 30; ++i)
      ProbeRun::expect(baked, i, lights == ProbeLights::no_lamps, false, true);
  }
}

TEST(BakeProbes, DifferencesAreBakedOverTheSameAtlas) {
  ProbeRun bake(700, ProbeLights::no_lamps);
  (void)bake.run();
  for (const auto& request : bake.blender.requests) {
    const auto& atlas = request.at("atlases");
    EXPECT_EQ(atlas, bake.blender.requests[0].at("atlases"));
  }
}

TEST(BakeProbes, WithoutLampsThereIsNothingToTakeAway) {
  ProbeRun bake(3, ProbeLights::no_lamps);
  bake.survey.lights.clear();
  (void)bake.run();
  EXPECT_EQ(bake.blender.requests.size(), 1U);
}

TEST(BakeProbes, WithoutBouncesOnlyDirectLightIsLeft) {
  ProbeRun bounced(3, ProbeLights::bounced);
  bounced.config.globals.bake.bounces = 0;
  const BakedProbes nothing = bounced.run();
  EXPECT_TRUE(bounced.blender.requests.empty());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(nothing.baked[i]);
    ProbeRun::expect(nothing, i, false, false, false);
  }
  ProbeRun no_lamps(3, ProbeLights::no_lamps);
  no_lamps.config.globals.bake.bounces = 0;
  const BakedProbes glow = no_lamps.run();
  for (std::size_t i = 0; i < 3; ++i) ProbeRun::expect(glow, i, true, false, false);
}

TEST(BakeProbes, FollowTheSettings) {
  ProbeRun bake(3);
  auto& settings = bake.config.globals;
  settings.object.samples = 7;
  settings.object.seed = 3;
  settings.object.clamp = 2;
  settings.bake.bounces = 5;
  settings.bake.recipe = BakingSettings::Recipe::flat_normal_map;  // of lightmaps
  settings.bake.dispatch = BakingSettings::Dispatch::basis;
  bake.wanted.absent = {"door", "lift/cabin#0"};
  (void)bake.run();
  ASSERT_EQ(bake.blender.requests.size(), 14U);
  for (const auto& request : bake.blender.requests) {
    EXPECT_EQ(request.at("recipe"), "receiver");
    EXPECT_EQ(request.at("absent"), nlohmann::json({"door", "lift/cabin#0"}));
    const nlohmann::json cycles{{"samples", 7},    {"seed", 3},     {"clamp", 2.0},    {"bounces", 5},
                                {"device", "CPU"}, {"lamps", true}, {"mirrors", false}};
    EXPECT_EQ(request.at("cycles"), cycles);
  }
}

TEST(BakeProbes, AnAtlasThatIsLimitedTakesSeveral) {
  ProbeRun bake(2500);
  bake.config.globals.bake.atlas_limit = 5000;
  const BakedProbes baked = bake.run();
  std::size_t atlases = 0;
  for (const auto& request : bake.blender.requests) atlases += request.at("atlases").size();
  EXPECT_GT(atlases, 6U);
  for (std::size_t i = 0; i < 2500; ++i) ProbeRun::expect(baked, i, true, true, true);
}

TEST(BakeProbes, WhereBlenderFailsTheOthersAreBaked) {
  ProbeRun bake(4000, ProbeLights::bounced);
  bake.blender.fails = [](double x) { return x == 2000; };
  const BakedProbes baked = bake.run();
  EXPECT_GT(bake.blender.failed, 1U);
  for (std::size_t i = 0; i < 4000; ++i) {
    const bool is_lost = i >= 1024 && i < 2048;
    ASSERT_EQ(baked.baked[i], !is_lost) << i;
    ProbeRun::expect(baked, i, false, false, !is_lost);
  }
}

TEST(BakeProbes, AProbeWithoutANumberIsLostAlone) {
  ProbeRun bake(50);
  bake.blender.has_no_number = [](double x) { return x == 17; };
  const BakedProbes baked = bake.run();
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(baked.baked[i], i != 17);
    if (i != 17) ProbeRun::expect(baked, i, true, true, true);
  }
  EXPECT_EQ(baked.irradiance[17 * 14], Vec3(0));
}

TEST(BakeProbes, NoPositionsNeedNoBlender) {
  ProbeRun bake(0);
  const BakedProbes baked = bake.run();
  EXPECT_TRUE(bake.blender.requests.empty());
  EXPECT_TRUE(baked.irradiance.empty());
}

}  // namespace
}  // namespace rnmbake
