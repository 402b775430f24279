#include "pipeline/lightmaps/bake_collector.h"

#include "base/error.h"
#include "base/files.h"
#include "image/display_png.h"
#include "image/layered_exr.h"
#include "lightmap/metadata.h"
#include "pipeline/fixture.h"

#include <csignal>
#include <limits>

#include <sys/resource.h>

namespace rnmbake {
namespace {

/// Textures for every tile of a dispatch: `value` for the first basis, twice that for the second, ...
std::vector<BakedPicture> pictures_of(const Plan& plan, const BatchLayout& layout, float value = 0.5F) {
  std::vector<BakedPicture> pictures;
  for (const std::size_t rect : layout.rects) {
    FloatImage picture(plan.rects[rect].size.width, plan.rects[rect].size.height, 4);
    std::fill(picture.data().begin(), picture.data().end(), value * float(plan.rects[rect].pass.basis + 1));
    for (std::size_t i = 3; i < picture.data().size(); i += 4) picture.data()[i] = 1;
    pictures.emplace_back().add(0, std::move(picture), 256);
  }
  return pictures;
}

BatchLayout layout_of(const Plan& plan, const Batch& batch) {
  BatchLayout layout;
  for (const std::size_t task : batch.tasks)
    layout.rects.insert(layout.rects.end(), plan.tasks[task].rects.begin(), plan.tasks[task].rects.end());
  return layout;
}

struct Desk {
  explicit Desk(const BakeSettings& settings = {}, std::size_t objects = 1, bool preview = false)
      : scene(objects, settings),
        context(scene.context()),
        collector(context, scene.settings().output, scene.headers(), preview) {}

  void take(const std::vector<std::size_t>& tasks, float value = 0.5F) {
    const Batch batch{tasks};
    const BatchLayout layout = layout_of(scene.plan(), batch);
    collector.take(batch, layout, pictures_of(scene.plan(), layout, value));
  }
  void preview(const std::vector<std::size_t>& tasks, float value = 0.5F) {
    const BatchLayout layout = layout_of(scene.plan(), {tasks});
    collector.preview(layout, pictures_of(scene.plan(), layout, value));
  }
  /// Names in the folder of previews.
  [[nodiscard]] std::vector<std::string> previews() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(scene.folder() / "preview"))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }
  [[nodiscard]] LayeredImage read(const std::string& name) const { return read_image(scene.folder() / name); }

  Invented scene;
  BakeContext context;
  BakeCollector collector;
};

/// Nothing larger than `bytes` can be written in its scope: what a full disk does, without one.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(BakeCollector, WritesATargetWhenItsLastUnitArrives) {
  Desk d({}, 2);
  d.take({0, 1, 2, 4});
  EXPECT_TRUE(d.scene.files().empty());
  EXPECT_FALSE(d.collector.is_settled(0));
  d.take({3});
  EXPECT_TRUE(d.collector.is_settled(0));
  EXPECT_FALSE(d.collector.is_settled(1));
  EXPECT_EQ(d.scene.files(), std::vector<std::string>{"object0.exr"});
  const auto& delivered = std::get<Delivered>(*d.collector.deliveries()[0]);
  EXPECT_EQ(delivered.files, std::vector<std::string>{"object0.exr"});
  EXPECT_EQ(delivered.counts.covered_texels, 64U);
}

TEST(BakeCollector, ShowsTargetsUntilTheyAreThere) {
  Desk d({}, 3, true);
  d.preview({0, 1, 2, 3, 4, 5, 6}, 0.25F);
  EXPECT_EQ(d.previews(), std::vector<std::string>{"object0.png"}) << "of the second a map is missing";
  const LayeredImage picture = d.read("preview/object0.png");
  EXPECT_NEAR(picture.layers.front().pixels.texel(3, 3)[0], srgb_encode(0.25F), 0.5 / 255);
  d.preview({7, 8, 9, 10, 11});
  EXPECT_EQ(d.previews(), (std::vector<std::string>{"object0.png", "object1.png", "object2.png"}));
  d.take({0, 1, 2, 3});
  d.collector.give_up(1, "hung");
  EXPECT_EQ(d.previews(), std::vector<std::string>{"object2.png"});
  d.preview({0, 1, 2, 3, 4, 5, 6, 7});
  EXPECT_EQ(d.previews(), std::vector<std::string>{"object2.png"}) << "those are there, or never will be";
  d.take({8, 9, 10, 11});
  EXPECT_EQ(d.previews(), std::vector<std::string>{});
}

TEST(BakeCollector, RemovesTheFolderOfPreviewsUnlessSomethingElseIsInIt) {
  Invented scene(1);
  const BakeContext context = scene.context();
  const BatchLayout layout = layout_of(scene.plan(), {{0, 1, 2, 3}});
  for (const bool is_used : {false, true}) {
    {
      BakeCollector collector(context, scene.settings().output, scene.headers(), true);
      collector.preview(layout, pictures_of(scene.plan(), layout));
      EXPECT_EQ(scene.files(), std::vector<std::string>{"preview"});
      if (is_used) write_atomically(scene.folder() / "preview" / "mine.txt", "mine");
    }
    EXPECT_EQ(std::filesystem::exists(scene.folder() / "preview"), is_used);
    EXPECT_FALSE(std::filesystem::exists(scene.folder() / "preview" / "object0.png"));
  }
}

TEST(BakeCollector, LayersHoldAllBasesAndCoverage) {
  Desk d;
  d.take({0, 1, 2, 3}, 0.25F);
  const LayeredImage image = d.read("object0.exr");
  for (const char* name : {"", "rnm0", "rnm1", "rnm2", "coverage"})
    ASSERT_NE(image.find(name), nullptr) << name;
  EXPECT_EQ(image.find("")->pixels.texel(3, 3)[1], 0.25F);
  EXPECT_EQ(image.find("rnm1")->pixels.texel(3, 3)[1], 0.75F);
  const LightmapMetadata metadata = read_metadata(image, "object0.exr");
  EXPECT_EQ(metadata.object, "object0");
  EXPECT_EQ(metadata.bases.size(), 4U);
}

TEST(BakeCollector, FilesHoldOneLayerEachAndSayWhich) {
  BakeSettings settings;
  settings.output.layout = OutputSettings::Layout::files;
  Desk d(settings);
  d.take({0, 1, 2, 3});
  EXPECT_EQ(d.scene.files(),
            (std::vector<std::string>{"object0.coverage.exr", "object0.flat.exr", "object0.rnm0.exr",
                                      "object0.rnm1.exr", "object0.rnm2.exr"}));
  auto listed = std::get<Delivered>(*d.collector.deliveries()[0]).files;
  std::sort(listed.begin(), listed.end());
  EXPECT_EQ(listed, d.scene.files());
  for (const BasisDirection& basis : d.context.bases) {
    const LayeredImage image = d.read("object0." + basis.name + ".exr");
    ASSERT_EQ(image.layers.size(), 1U);
    EXPECT_EQ(image.layers[0].channels, (std::vector<std::string>{"R", "G", "B"}));
    const bool is_flat = basis.name == "flat";
    EXPECT_EQ(image.layers[0].pixels.texel(2, 3)[1], is_flat ? 0.5F : float(basis.name.back() - '0' + 2) / 2);
    EXPECT_EQ(image.attributes.at("rnmbake:layer"), Attribute(basis.name));
    const auto vector = std::get<std::vector<float>>(image.attributes.at("rnmbake:basis:" + basis.name));
    EXPECT_EQ(vector, (std::vector<float>{basis.direction.x, basis.direction.y, basis.direction.z}));
    EXPECT_EQ(read_metadata(image, basis.name).bases.size(), 4U);
  }
}

TEST(BakeCollector, SaysInTheHeaderThatTexelsWereRepaired) {
  for (const bool repair : {false, true}) {
    BakeSettings settings;
    settings.output.repair = repair;
    Desk d(settings);
    const Batch batch{{0, 1, 2, 3}};
    const BatchLayout layout = layout_of(d.scene.plan(), batch);
    auto pictures = pictures_of(d.scene.plan(), layout);
    pictures[2].halves[0].texel(4, 4)[0] = std::numeric_limits<float>::quiet_NaN();
    d.collector.take(batch, layout, std::move(pictures));
    EXPECT_EQ(read_metadata(d.read("object0.exr"), "object0.exr").repaired, repair);
    EXPECT_EQ(std::get<Delivered>(*d.collector.deliveries()[0]).counts.repaired, repair ? 1U : 0U);
  }
}

TEST(BakeCollector, GivesUpAMapWithoutANumberAndLosesNothingElse) {
  for (const bool repair : {false, true}) {
    BakeSettings settings;
    settings.output.repair = repair;
    Desk d(settings, 2);
    d.take({0, 1, 2, 3}, std::numeric_limits<float>::quiet_NaN());
    d.take({4, 5, 6, 7});
    EXPECT_EQ(d.scene.files(), std::vector<std::string>{"object1.exr"});
    EXPECT_NE(std::get<NotDelivered>(*d.collector.deliveries()[0]).reason.find("NaN"), std::string::npos);
    EXPECT_TRUE(std::holds_alternative<Delivered>(*d.collector.deliveries()[1]));
    EXPECT_EQ(count_failed(d.collector.deliveries()), 1U);
  }
}

TEST(BakeCollector, DoesNotWriteWhatWasGivenUp) {
  Desk d({}, 2);
  d.take({0, 1});
  d.collector.give_up(0, "the reason");
  d.take({2, 3, 4, 5, 6, 7});
  EXPECT_EQ(d.scene.files(), std::vector<std::string>{"object1.exr"});
  EXPECT_EQ(reason_of(d.collector, 0), "the reason");
}

TEST(BakeCollector, KeepsTheFirstReasonAndWhatWasDelivered) {
  Desk d({}, 2);
  d.collector.give_up(0, "first");
  d.collector.give_up(0, "second");
  EXPECT_EQ(reason_of(d.collector, 0), "first");
  d.take({4, 5, 6, 7});
  d.collector.give_up(1, "too late");
  EXPECT_TRUE(is_delivered(d.collector, 1));
}

TEST(BakeCollector, GivesUpATargetWithoutATexelAndGoesOn) {
  Desk d({}, 2);
  const Batch batch{{0, 1, 2, 3, 4, 5, 6, 7}};
  const BatchLayout layout = layout_of(d.scene.plan(), batch);
  auto pictures = pictures_of(d.scene.plan(), layout);
  for (std::size_t i = 0; i < 4; ++i) std::ranges::fill(pictures[i].halves[0].data(), 0.0F);
  d.collector.take(batch, layout, std::move(pictures));
  EXPECT_NE(reason_of(d.collector, 0).find("no texel of 'object0'"), std::string::npos);
  EXPECT_TRUE(is_delivered(d.collector, 1));
}

TEST(BakeCollector, PassesOnThatTheDiskIsFullAndLeavesNothingBehind) {
  Desk d;
  const FileSizeLimit limit(64);
  try {
    d.take({0, 1, 2, 3});
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
    EXPECT_NE(std::string(error.what()).find("object0.exr"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(d.scene.files().empty());
}

}  // namespace
}  // namespace rnmbake
