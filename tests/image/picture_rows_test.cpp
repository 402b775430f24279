#include "image/picture_rows.h"

#include "base/error.h"
#include "base/files.h"

#include <cmath>
#include <cstdlib>
#include <numeric>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

struct Case {
  const char* file;
  Storage storage;
  double step;  // between two stored values near 1
};

std::vector<float> ramp(const PictureForm& form) {
  std::vector<float> values(static_cast<std::size_t>(form.width) * form.height * form.channels.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(i % 251) / 250;  // alpha of 0 included
  return values;
}

void write(const std::filesystem::path& file, const PictureForm& form, const std::vector<float>& values) {
  PictureWriter writer(file, form);
  const std::size_t row = values.size() / static_cast<std::size_t>(form.height);
  for (int y = 0; y < form.height; y += 3) {
    const int end = std::min(y + 3, form.height);
    writer.write(y, end, std::span(values).subspan(y * row, (end - y) * row));
  }
  writer.commit();
}

PictureForm rgba(int width, int height, Storage storage) {
  return {width,
          height,
          {"R", "G", "B", "A"},
          storage,
          {{"rnmbake:scale", Attribute(std::string("third"))},
           {"ImageDescription", Attribute(std::string("weights of three; scale=third"))}}};
}

ExitCode refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::ok;
}

class PictureRows : public testing::TestWithParam<Case> {};

TEST_P(PictureRows, ComeBackAsTheyWereWritten) {
  const TempFolder folder;
  const auto file = folder.path() / GetParam().file;
  const PictureForm form = rgba(17, 11, GetParam().storage);
  const std::vector<float> values = ramp(form);
  write(file, form, values);

  PictureReader reader(file);
  ASSERT_EQ(reader.facts().width, 17);
  ASSERT_EQ(reader.facts().height, 11);
  EXPECT_EQ(reader.facts().channels, form.channels);
  EXPECT_EQ(reader.facts().is_integer, GetParam().storage <= Storage::u16);
  std::vector<float> row(17 * 4), one(17);
  for (int y = 0; y < 11; ++y) {
    reader.read(y, y + 1, 0, 4, row);
    for (std::size_t i = 0; i < row.size(); ++i)
      ASSERT_NEAR(row[i], values[y * row.size() + i], GetParam().step / 2 + 1e-7) << y << " " << i;
  }
  reader.read(4, 5, 1, 1, one);  // one channel, and back to a row that was passed
  EXPECT_NEAR(one[2], values[4 * row.size() + 9], GetParam().step / 2 + 1e-7);
  EXPECT_EQ(reader.facts().attributes.at("ImageDescription"), form.attributes.at("ImageDescription"));
  const std::string name = GetParam().file;
  if (name.ends_with(".exr") || name.ends_with(".png") || name.ends_with(".PNG")) {
    EXPECT_EQ(reader.facts().attributes.at("rnmbake:scale"), Attribute(std::string("third")));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Formats, PictureRows,
    testing::Values(Case{"a.png", Storage::u8, 1.0 / 255}, Case{"b.PNG", Storage::u16, 1.0 / 65535},
                    Case{"c.tga", Storage::u8, 1.0 / 255}, Case{"d.tif", Storage::u8, 1.0 / 255},
                    Case{"e.tiff", Storage::u16, 1.0 / 65535}, Case{"f.tif", Storage::half, 1.0 / 1024},
                    Case{"g.tif", Storage::full, 0}, Case{"h.exr", Storage::half, 1.0 / 1024},
                    Case{"i.exr", Storage::full, 0}),
    [](const auto& tested) {
      std::string name = tested.param.file;
      for (char& c : name)
        if (c == '.') c = '_';
      return name;
    });

TEST(PictureWriter, NamesTheEndingsThatHoldTheValues) {
  EXPECT_EQ(storage_obstacle("a.png", Storage::full),
            ".png holds no float values; use one of .tif, .tiff, .exr");
  EXPECT_NE(storage_obstacle("a.jpg", Storage::u8), "");
  EXPECT_EQ(storage_obstacle("a.exr", Storage::half), "");
  EXPECT_EQ(refusal([] { PictureWriter("a.tga", rgba(4, 4, Storage::u16)); }), ExitCode::usage);
}

TEST(PictureWriter, LeavesNothingBehindUnlessCommitted) {
  const TempFolder folder;
  {
    PictureWriter writer(folder.path() / "a.png", rgba(4, 4, Storage::u8));
    writer.write(0, 1, std::vector<float>(16, 0.5F));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_EQ(refusal([&] { PictureWriter(folder.path() / "none/a.png", rgba(4, 4, Storage::u8)); }),
            ExitCode::io);
  EXPECT_EQ(refusal([] {
              const PictureForm form = rgba(64, 64, Storage::full);
              write("/dev/full/a.exr", form, ramp(form));
            }),
            ExitCode::io);
}

TEST(PictureWriter, DeclaresNoTransferCurveInPng) {
  const TempFolder folder;
  const PictureForm form = rgba(4, 4, Storage::u8);
  write(folder.path() / "a.png", form, ramp(form));
  const std::string bytes = read_text(folder.path() / "a.png");
  EXPECT_EQ(bytes.find("gAMA"), std::string::npos);
  EXPECT_EQ(bytes.find("sRGB"), std::string::npos);
}

TEST(PictureReader, ReadsTiles) {
  const TempFolder folder;
  const PictureForm form = rgba(40, 23, Storage::full);
  const std::vector<float> values = ramp(form);
  const auto plain = folder.path() / "plain.exr", tiled = folder.path() / "tiled.exr";
  write(plain, form, values);
  const std::string command = "oiiotool " + plain.string() + " --tile 16 16 -o " + tiled.string();
  if (std::system(command.c_str()) != 0) GTEST_SKIP() << "no oiiotool";  // NOLINT
  PictureReader reader(tiled);
  std::vector<float> rows(40 * 2 * 10);
  reader.read(12, 22, 1, 2, rows);
  for (int i = 0; i < 400; ++i) {
    ASSERT_EQ(rows[2 * i], values[4 * (12 * 40 + i) + 1]);
    ASSERT_EQ(rows[2 * i + 1], values[4 * (12 * 40 + i) + 2]);
  }
}

TEST(PictureReader, RefusesWhatIsCutOff) {
  const TempFolder folder;
  for (const char* name : {"a.png", "a.tif", "a.exr", "a.tga"}) {
    const auto file = folder.path() / name;
    const Storage storage = storage_obstacle(file, Storage::u8).empty() ? Storage::u8 : Storage::half;
    const PictureForm form = rgba(200, 100, storage);
    write(file, form, ramp(form));
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    EXPECT_EQ(refusal([&] {
                PictureReader reader(file);
                std::vector<float> all(200 * 100 * 4);
                reader.read(0, 100, 0, 4, all);
              }),
              ExitCode::invalid_input)
        << name;
  }
}

}  // namespace
}  // namespace rnmbake
