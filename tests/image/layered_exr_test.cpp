#include "image/layered_exr.h"

#include "base/error.h"
#include "base/files.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

FloatImage noise(int width, int height, int channels, unsigned seed) {
  FloatImage image(width, height, channels);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-2, 100);
  for (float& value : image.data()) value = uniform(random);
  return image;
}

/// Layers in an order that is not the alphabet's, with every kind of channel that a lightmap has.
LayeredImage lightmap_like(int width, int height) {
  LayeredImage image;
  image.layers.push_back({"", {"R", "G", "B"}, noise(width, height, 3, 1)});
  image.layers.push_back({"rnm0", {"R", "G", "B"}, noise(width, height, 3, 2)});
  image.layers.push_back({"zenith", {"R", "G", "B"}, noise(width, height, 3, 3)});
  image.layers.push_back({"below", {"R", "G", "B"}, noise(width, height, 3, 4)});
  image.layers.push_back({"tangent", {"X", "Y", "Z", "S"}, noise(width, height, 4, 5)});
  image.layers.push_back({"normal", {"X", "Y", "Z"}, noise(width, height, 3, 6)});
  image.layers.push_back({"coverage", {""}, noise(width, height, 1, 7)});
  return image;
}

void expect_same_layers(const LayeredImage& read, const LayeredImage& written, float relative) {
  ASSERT_EQ(read.layers.size(), written.layers.size());
  for (const Layer& layer : written.layers) {
    const Layer* found = read.find(layer.name);
    ASSERT_NE(found, nullptr) << layer.name;
    EXPECT_EQ(found->channels, layer.channels) << layer.name;
    ASSERT_EQ(found->pixels.data().size(), layer.pixels.data().size()) << layer.name;
    EXPECT_EQ(found->pixels.width(), layer.pixels.width());
    for (std::size_t i = 0; i < layer.pixels.data().size(); ++i) {
      const float value = layer.pixels.data()[i];
      ASSERT_NEAR(found->pixels.data()[i], value, std::abs(value) * relative) << layer.name << " " << i;
    }
  }
}

template <typename Action>
void expect_error(ExitCode code, const std::string& part, Action action) {
  try {
    action();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

class LayeredExr : public testing::Test {
 protected:
  [[nodiscard]] fs::path path(const std::string& name) const { return folder_.path() / name; }
  [[nodiscard]] std::size_t files_there() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }

  TempFolder folder_;
};

TEST_F(LayeredExr, FloatRoundTripIsExactForAnyShape) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 7}, {1, 33}, {65, 1}, {64, 130}}) {
    const LayeredImage image = lightmap_like(width, height);
    write_exr(path("a.exr"), image, Depth::full);
    expect_same_layers(read_image(path("a.exr")), image, 0);
  }
  EXPECT_EQ(files_there(), 1U);
}

TEST_F(LayeredExr, HalfRoundTripIsWithinHalfPrecision) {
  const LayeredImage image = lightmap_like(13, 5);
  write_exr(path("a.exr"), image, Depth::half);
  expect_same_layers(read_image(path("a.exr")), image, 1.0F / 2048);
}

TEST_F(LayeredExr, HalfKeepsItsLargestValueAndNaN) {
  LayeredImage image;
  image.layers.push_back({"", {"R", "G", "B"}, FloatImage(1, 1, 3)});
  image.layers[0].pixels.data() = {65504, std::numeric_limits<float>::quiet_NaN(),
                                   std::numeric_limits<float>::infinity()};
  write_exr(path("a.exr"), image, Depth::half);
  const auto values = read_image(path("a.exr")).find("")->pixels.data();
  EXPECT_EQ(values[0], 65504);
  EXPECT_TRUE(std::isnan(values[1]));
  EXPECT_TRUE(std::isinf(values[2]));
}

TEST_F(LayeredExr, AttributesComeBackAsWritten) {
  LayeredImage image = lightmap_like(2, 2);
  image.attributes = {{"rnmbake:text", std::string("clipped hemisphere integral")},
                      {"rnmbake:unicode", std::string("Wände/ö")},
                      {"rnmbake:whole", -7},
                      {"rnmbake:number", 0.25F},
                      {"rnmbake:basis:rnm0", std::vector<float>{0.816497F, 0, 0.57735F}},
                      {"rnmbake:two", std::vector<float>{1, 2}},
                      {"rnmbake:five", std::vector<float>{1, 2, 3, 4, 5}},
                      {"rnmbake:sixteen", std::vector<float>(16, 2.5F)}};
  write_exr(path("a.exr"), image, Depth::half);
  const LayeredImage read = read_image(path("a.exr"));
  for (const auto& [name, value] : image.attributes) {
    ASSERT_TRUE(read.attributes.contains(name)) << name;
    EXPECT_EQ(read.attributes.at(name), value) << name;
  }
}

TEST_F(LayeredExr, EqualImagesGiveEqualBytes) {
  write_exr(path("a.exr"), lightmap_like(9, 9), Depth::half);
  write_exr(path("b.exr"), lightmap_like(9, 9), Depth::half);
  EXPECT_EQ(read_text(path("a.exr")), read_text(path("b.exr")));
}

TEST_F(LayeredExr, LayersThatDoNotFitTogetherAreRefused) {
  LayeredImage image = lightmap_like(4, 4);
  image.layers[2].pixels = FloatImage(4, 5, 3);
  expect_error(ExitCode::invalid_input, "'zenith'", [&] { write_exr(path("a.exr"), image, Depth::half); });
  image = lightmap_like(4, 4);
  image.layers[1].channels.pop_back();
  expect_error(ExitCode::invalid_input, "channel names",
               [&] { write_exr(path("a.exr"), image, Depth::half); });
  expect_error(ExitCode::invalid_input, "no layer", [&] { write_exr(path("a.exr"), {}, Depth::half); });
  EXPECT_EQ(files_there(), 0U);
}

TEST_F(LayeredExr, TruncatedFilesAreRefusedWhereverTheyEnd) {
  write_exr(path("a.exr"), lightmap_like(40, 70), Depth::full);
  const std::string bytes = read_text(path("a.exr"));
  for (const double part : {0.001, 0.01, 0.1, 0.5, 0.9, 0.999}) {
    write_atomically(path("cut.exr"), std::string_view(bytes).substr(
                                          0, static_cast<std::size_t>(part * double(bytes.size()))));
    expect_error(ExitCode::invalid_input, "cut.exr is damaged", [&] { (void)read_image(path("cut.exr")); });
  }
}

TEST_F(LayeredExr, DamagedPixelsAreRefused) {
  write_exr(path("a.exr"), lightmap_like(40, 70), Depth::full);
  std::string bytes = read_text(path("a.exr"));
  std::fill(bytes.end() - static_cast<std::ptrdiff_t>(bytes.size() / 2), bytes.end(), '\xff');
  write_atomically(path("bad.exr"), bytes);
  expect_error(ExitCode::invalid_input, "bad.exr", [&] { (void)read_image(path("bad.exr")); });
}

TEST_F(LayeredExr, WhatIsNoPictureIsRefused) {
  write_atomically(path("empty.exr"), std::string_view());
  write_atomically(path("text.exr"), std::string_view("not a picture at all"));
  expect_error(ExitCode::invalid_input, "empty.exr", [&] { (void)read_image(path("empty.exr")); });
  expect_error(ExitCode::invalid_input, "text.exr", [&] { (void)read_image(path("text.exr")); });
  expect_error(ExitCode::io, "No such file", [&] { (void)read_image(path("missing.exr")); });
  expect_error(ExitCode::io, "folder", [&] { (void)read_image(folder_.path()); });
}

TEST_F(LayeredExr, UnwritableFolderIsNamed) {
  expect_error(ExitCode::io, "No such file",
               [&] { write_exr(path("no/a.exr"), lightmap_like(2, 2), Depth::half); });
  write_atomically(path("file"), std::string_view("x"));
  expect_error(ExitCode::io, "file/a.exr",
               [&] { write_exr(path("file/a.exr"), lightmap_like(2, 2), Depth::half); });
}

/// A file system of our own, so that root too meets its limits; gone at the end of the scope.
class SmallDisk {
 public:
  SmallDisk(fs::path at, const char* options) : at_(std::move(at)) {
    fs::create_directory(at_);
    mounted_ = ::mount("tmpfs", at_.c_str(), "tmpfs", 0, options) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount(at_.c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  [[nodiscard]] bool mounted() const { return mounted_; }
  void make_read_only() const { ::mount("tmpfs", at_.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr); }

 private:
  fs::path at_;
  bool mounted_ = false;
};

TEST_F(LayeredExr, ReadOnlyFolderIsNamed) {
  if (::geteuid() != 0) {
    fs::create_directory(path("closed"));
    ::chmod(path("closed").c_str(), 0500);
    expect_error(ExitCode::io, "Permission denied",
                 [&] { write_exr(path("closed/a.exr"), lightmap_like(2, 2), Depth::half); });
    return;
  }
  const SmallDisk disk(path("closed"), "size=64k");
  if (!disk.mounted())
    GTEST_SKIP() << "SKIPPED: root may write everywhere and cannot mount a read-only tmpfs here";
  disk.make_read_only();
  expect_error(ExitCode::io, "closed/a.exr: Read-only",
               [&] { write_exr(path("closed/a.exr"), lightmap_like(2, 2), Depth::half); });
}

TEST_F(LayeredExr, FullDiskKeepsTheOldFileAndLeavesNothingElse) {
  const SmallDisk disk(path("full"), "size=64k");
  if (!disk.mounted()) GTEST_SKIP() << "SKIPPED: cannot mount a small tmpfs; run as root to test a full disk";
  write_exr(path("full/a.exr"), lightmap_like(4, 4), Depth::full);
  const std::string before = read_text(path("full/a.exr"));
  expect_error(ExitCode::io, "disk is full",
               [&] { write_exr(path("full/a.exr"), lightmap_like(128, 128), Depth::full); });
  EXPECT_EQ(read_text(path("full/a.exr")), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(path("full")), fs::directory_iterator()), 1);
}

}  // namespace
}  // namespace rnmbake
