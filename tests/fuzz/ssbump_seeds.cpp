// ssbump_seeds FOLDER: flags and small pictures from which fuzzing starts.
#include "base/files.h"
#include "image/picture_rows.h"

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace rnmbake;

std::string picture(const TempFolder& folder, const char* ending, std::vector<std::string> channels,
                    Storage storage) {
  const auto file = folder.path() / (std::string("seed") + ending);
  const PictureForm form{5, 4, std::move(channels), storage, {}};
  std::vector<float> values(5 * 4 * form.channels.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i * 7 % 11) / 11;
  PictureWriter writer(file, form);
  writer.write(0, 4, values);
  writer.commit();
  return read_text(file);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: ssbump_seeds FOLDER\n");
    return 1;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const TempFolder made;
  const std::vector<std::pair<std::string, std::string>> seeds{
      {"--height=3 --wrap=mirror", picture(made, ".png", {"R", "G", "B", "A"}, Storage::u8)},
      {"--channel=alpha --invert -A", picture(made, ".tga", {"R", "G", "B", "A"}, Storage::u8)},
      {"--filter-radius=2 --edge-threshold=0.5", picture(made, ".exr", {"Y"}, Storage::half)},
      {"--height-world=2 --texel-size=0.5 --ao-only", picture(made, ".tif", {"Y"}, Storage::full)},
      {"--method=trace --rays=2 --power=3 --bounces=1", picture(made, ".png", {"Y"}, Storage::u16)},
      {"--method=cone --scale=mod2x --handed=left", "P2\n3 2\n255\n1 2 3 4 5 6\n"}};
  int count = 0;
  for (const auto& [flags, bytes] : seeds)
    write_atomically(folder / ("seed" + std::to_string(count++)), flags + "\n" + bytes);
  return 0;
}
