#include "bake/request.h"

#include "bake/fixture.h"
#include "base/files.h"
#include "encoding/basis_set.h"
#include "scene/test_meshes.h"

#include <algorithm>
#include <fstream>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

std::vector<float> read_floats(const fs::path& file) {
  std::vector<float> values(fs::file_size(file) / sizeof(float));
  std::ifstream(file, std::ios::binary)
      .read(reinterpret_cast<char*>(values.data()), std::streamsize(values.size() * sizeof(float)));
  return values;
}

void write_floats(const fs::path& file, const std::vector<float>& values) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(values.data()), std::streamsize(values.size() * sizeof(float)));
}

/// Three objects, the last of them in a light group of its own.
class Requests : public testing::Test {
 protected:
  Requests() {
    survey_.meshes.push_back(square());
    for (const char* name : {"a", "b", "lit"}) {
      SceneObject object;
      object.key = object.name = name;
      object.mesh = 0;
      object.light_group = object.name == "lit" ? "lamps" : "";
      targets_.push_back(make_target(name, 32, 16, survey_.objects.size()));
      survey_.objects.push_back(object);
    }
  }

  void add_all() {
    for (std::size_t t = 0; t < targets_.size(); ++t)
      add_receiver_tasks(plan_, plan_target(survey_, targets_[t]), plain_sheets(4, 0.25F, 0.5F),
                         task_names(bases_), {});
    group_tasks(plan_, BakingSettings::Dispatch::scene);
  }
  [[nodiscard]] BakeContext context() const { return {survey_, targets_, bases_, plan_}; }

  SceneSurvey survey_;
  std::vector<Target> targets_;
  std::vector<BasisDirection> bases_ = flat_and_rnm().directions;
  Plan plan_;
  TempFolder folder_;
};

TEST_F(Requests, OfReceiversDescribeTheirArrays) {
  add_all();
  const BakeRequest request = receiver_request(plan_, plan_.batches[0], 1 << 20, folder_.path());
  EXPECT_EQ(request.json.at("recipe"), "receiver");
  EXPECT_EQ(request.json.at("cycles").at("samples"), 256);
  ASSERT_EQ(request.json.at("atlases").size(), 1U);
  const auto& atlas = request.json["atlases"][0];
  ASSERT_EQ(atlas.at("groups").size(), 2U);
  EXPECT_EQ(atlas["groups"][0].at("corners"), 2 * 4 * 3);
  EXPECT_EQ(atlas["groups"][0].at("light_group"), "");
  EXPECT_EQ(atlas["groups"][1].at("corners"), 4 * 3);
  EXPECT_EQ(atlas["groups"][1].at("light_group"), "lamps");
  std::int64_t texels = 0;
  for (const AtlasRect& rect : plan_.rects) texels += std::int64_t(rect.size.width) * rect.size.height;
  EXPECT_EQ(atlas.at("covered_texels"), texels);
  EXPECT_EQ(read_floats(folder_.path() / atlas.at("arrays")).size(), 36U * (3 + 3 + 2));
}

TEST_F(Requests, OfReceiversLeaveOutGroupsWithoutATriangle) {
  add_all();
  for (AtlasRect& rect : plan_.rects) {
    if (plan_.targets[rect.target].light_group == "lamps") rect.pass.corners.clear();
  }
  const BakeRequest request = receiver_request(plan_, plan_.batches[0], 1 << 20, folder_.path());
  const auto& groups = request.json.at("atlases").at(0).at("groups");
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].at("light_group"), "");
  EXPECT_EQ(request.layout.rects.size(), 12U);
}

TEST_F(Requests, OfReceiversPlaceUvsOnTheirTiles) {
  add_all();
  const BakeRequest request = receiver_request(plan_, plan_.batches[0], 1 << 20, folder_.path());
  const auto& atlas = request.json["atlases"][0];
  const auto values = read_floats(folder_.path() / atlas.at("arrays"));
  const std::size_t corners = atlas["groups"][0].at("corners");
  for (std::size_t i = 0; i < corners / 3; ++i) {  // one triangle for each tile, in the layout's order
    const AtlasRect& rect = plan_.rects[request.layout.rects[i]];
    const Placement& place = request.layout.atlas.placements[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const float* uv = &values[corners * 6 + (3 * i + k) * 2];
      const Vec2 expected = rect.pass.corners[k].uv;
      EXPECT_NEAR(uv[0] * atlas.at("width").get<float>(), expected.x * 32 - float(rect.x) + float(place.x),
                  1e-4);
      EXPECT_NEAR(uv[1] * atlas.at("height").get<float>(), expected.y * 16 - float(rect.y) + float(place.y),
                  1e-4);
    }
  }
}

TEST_F(Requests, OfReceiversBringTheFencesOfTheirTargets) {
  add_all();
  plan_.guards.emplace();
  const auto fences_of = [&](const Batch& batch) {
    return receiver_request(plan_, batch, 1 << 20, folder_.path()).json.at("guards").at("fences");
  };
  EXPECT_EQ(fences_of(plan_.batches[0]).at("count"), 0);
  plan_.guards->fences.resize(3);
  plan_.guards->fences[0].push_back(Fence{{Vec3(1), Vec3(2), Vec3(3), Vec3(4)}, Vec3(0, 0, 1)});
  plan_.guards->fences[2].push_back(Fence{{Vec3(5), Vec3(6), Vec3(7), Vec3(8)}, Vec3(1, 0, 0)});
  Batch last;  // of "lit" alone
  for (const std::size_t task : plan_.batches[0].tasks)
    if (plan_.tasks[task].target == 2) last.tasks.push_back(task);
  const auto fences = fences_of(last);
  EXPECT_EQ(fences.at("count"), 1);
  const auto values = read_floats(folder_.path() / fences.at("arrays"));
  ASSERT_EQ(values.size(), 24U);
  EXPECT_EQ(values[3], 6);
  for (std::size_t i = 12; i < 24; ++i) EXPECT_EQ(values[i], i % 3 == 0 ? 1 : 0);
}

TEST_F(Requests, OfReceiversSayHowHighTheyStandOverWhatGlows) {
  survey_.meshes[0].polygon_slot = {5};  // past the last slot: Blender takes that
  survey_.objects[0].slots = {"dull", "lamp"};
  survey_.objects[1].slots = {"lamp"};
  survey_.objects[2].slots = {"dull"};
  survey_.materials["dull"] = {};
  survey_.materials["lamp"].emissive = true;
  Surface surface;
  for (const float height : {1e-6F, 3e-6F, 2e-6F}) surface.triangles.emplace_back().height = height;
  GlowHeights& heights = plan_.guards.emplace().glow_heights;
  note_glow(heights, survey_, 0, surface);
  surface.triangles.resize(1);
  note_glow(heights, survey_, 1, surface);
  note_glow(heights, survey_, 2, surface);
  add_all();
  const BakeRequest request = receiver_request(plan_, plan_.batches[0], 1 << 20, folder_.path());
  EXPECT_EQ(request.json.at("guards").at("glow_heights"), nlohmann::json({{"lamp", 3e-6F}}));
}

TEST_F(Requests, InFreeSpaceHaveNoGuards) {
  add_all();
  const BakeRequest request = receiver_request(plan_, plan_.batches[0], 1 << 20, folder_.path());
  EXPECT_FALSE(request.json.contains("guards"));
}

TEST_F(Requests, ThatDoNotFitOneAtlasTakeSeveral) {
  add_all();
  const BakeRequest request = receiver_request(plan_, plan_.batches[0], 200, folder_.path());
  const auto& atlases = request.json.at("atlases");
  ASSERT_GT(atlases.size(), 1U);
  EXPECT_EQ(atlases.size(), request.layout.atlas.atlases.size());
  std::size_t corners = 0;
  for (const auto& atlas : atlases) {
    EXPECT_LE(atlas.at("width").get<int>() * atlas.at("height").get<int>(), 200);
    for (const auto& group : atlas.at("groups")) corners += group.at("corners").get<std::size_t>();
  }
  EXPECT_EQ(corners, 36U);
}

TEST_F(Requests, OfObjectsNameLayersPartsAndBakes) {
  targets_[1].flip_green = true;
  targets_[1].part = {"red", {1}};
  targets_[2].unwrapped = true;
  targets_[2].uv = std::make_shared<const std::vector<Vec2>>(square_uv());
  for (std::size_t t = 0; t < 3; ++t)
    add_object_tasks(plan_, plan_target(survey_, targets_[t]), task_names(bases_), {});
  group_tasks(plan_, BakingSettings::Dispatch::scene);
  const BakeRequest request = object_request(context(), plan_.batches[0], true, folder_.path());
  EXPECT_EQ(request.json.at("recipe"), "flat-normal-map");
  EXPECT_EQ(request.json.at("correct_bump"), true);
  const auto& targets = request.json.at("targets");
  ASSERT_EQ(targets.size(), 3U);
  for (const auto& target : targets) {
    EXPECT_EQ(target.at("uv_layer"), "Lightmap");
    EXPECT_EQ(target.at("width"), 32);
    EXPECT_EQ(target.at("bakes").size(), 4U);
  }
  EXPECT_FALSE(targets[0].contains("polygons"));
  EXPECT_EQ(fs::file_size(folder_.path() / targets[1].at("polygons")), 4U);
  EXPECT_EQ(fs::file_size(folder_.path() / targets[2].at("uv_array")), 6U * 8);
  const float green = targets[0]["bakes"][2]["direction"][1];
  EXPECT_EQ(targets[1]["bakes"][2]["direction"][1].get<float>(), -green);
  EXPECT_EQ(request.layout.atlas.atlases.size(), 12U);
}

TEST_F(Requests, GetTheirTilesBackTopRowFirst) {
  add_all();
  const BakeRequest request = receiver_request(plan_, plan_.batches[0], 1 << 20, folder_.path());
  const RectSize size = request.layout.atlas.atlases[0];
  std::vector<float> pixels(std::size_t(size.width) * size.height * 4);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      float* pixel = &pixels[(std::size_t(y) * size.width + x) * 4];
      pixel[0] = float(x);
      pixel[1] = float(y);
      pixel[3] = 1;
    }
  }
  write_floats(folder_.path() / "pass0-0.f32", pixels);
  const auto rects = read_rects(request.layout, plan_, folder_.path());
  ASSERT_EQ(rects.size(), plan_.rects.size());
  for (std::size_t i = 0; i < rects.size(); ++i) {
    const Placement& place = request.layout.atlas.placements[i];
    const RectSize rect = plan_.rects[request.layout.rects[i]].size;
    ASSERT_EQ(rects[i].width(), rect.width);
    ASSERT_EQ(rects[i].height(), rect.height);
    EXPECT_EQ(rects[i].texel(0, rect.height - 1)[0], float(place.x));
    EXPECT_EQ(rects[i].texel(0, rect.height - 1)[1], float(place.y));
    EXPECT_EQ(rects[i].texel(rect.width - 1, 0)[0], float(place.x + rect.width - 1));
    EXPECT_EQ(rects[i].texel(rect.width - 1, 0)[1], float(place.y + rect.height - 1));
  }
}

TEST_F(Requests, RefuseShortAndMissingPictures) {
  add_all();
  const BakeRequest request = receiver_request(plan_, plan_.batches[0], 1 << 20, folder_.path());
  const auto read = [&] { (void)read_rects(request.layout, plan_, folder_.path()); };
  EXPECT_NE(error_of(ExitCode::tasks_failed, read).find("pass0-0.f32"), std::string::npos);
  const RectSize size = request.layout.atlas.atlases[0];
  write_floats(folder_.path() / "pass0-0.f32",
               std::vector<float>(std::size_t(size.width) * size.height * 4 - 1));
  EXPECT_NE(error_of(ExitCode::tasks_failed, read).find("is the disk full?"), std::string::npos);
}

TEST_F(Requests, ThatCannotBeWrittenNameTheFile) {
  add_all();
  const auto text = error_of(ExitCode::io, [&] {
    (void)receiver_request(plan_, plan_.batches[0], 1 << 20, folder_.path() / "absent");
  });
  EXPECT_NE(text.find("receivers0.f32"), std::string::npos) << text;
}

}  // namespace
}  // namespace rnmbake
