// Feeds broken pictures and odd flags to `rnmbake ssbump`: every input is turned into a map or refused with
// an Error, and the map can be read again. Run by ./dev fuzz ssbump.
//
// An input is a line of flags, separated by spaces, and the bytes of a picture.
#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "cli/ssbump/ssbump_flags.h"
#include "image/picture_rows.h"
#include "pipeline/ssbump/ssbump_run.h"
#include "ssbump/map/picture.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace {

using namespace rnmbake;

constexpr int most_texels = 4096;  // more is only slower

struct Input {
  std::vector<std::string> flags;
  std::string picture;
};

Input taken_apart(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const auto line_end = std::min(bytes.find('\n'), size);
  std::istringstream words(bytes.substr(0, line_end));
  Input input;
  for (std::string word; words >> word;) input.flags.push_back(word);
  input.picture = bytes.substr(std::min(line_end + 1, size));
  return input;
}

/// The format is in the first bytes; the ending only has to be one that no other reader claims first.
const char* ending_of(const std::string& picture) {
  if (picture.starts_with("P")) return ".pgm";
  if (picture.starts_with("\x89PNG")) return ".png";
  if (picture.starts_with("v/1\x01")) return ".exr";
  if (picture.starts_with("II") || picture.starts_with("MM")) return ".tif";
  return ".tga";
}

/// Flags as a user types them. Whatever file they name, ours stands in for it; Blender is not started.
SsbumpRunOptions parsed(std::vector<std::string> words, const std::filesystem::path& folder,
                        const std::filesystem::path& picture) {
  std::erase_if(words, [](const std::string& word) {
    return !word.starts_with("-") || word.starts_with("-o") || word.starts_with("--output");
  });
  CLI::App app;
  SsbumpFlags flags(app);
  words.push_back("--output=" + (folder / "out.exr").string());
  std::ranges::reverse(words);  // as CLI11 wants them
  app.parse(words);
  flags.input = picture;
  SsbumpRunOptions options = flags.options();
  options.baked = nullptr;
  if (!options.normal.empty()) options.normal = folder / "normals.exr";
  if (!options.dump_height.empty()) options.dump_height = folder / "heights.exr";
  if (!options.albedo.empty()) options.albedo = picture;
  options.generate.threads = 1;
  options.generate.rays = std::min(options.generate.rays, 4);
  options.generate.azimuths = std::clamp(options.generate.azimuths, 4, 16);
  options.generate.bounces = std::min(options.generate.bounces, 1);
  return options;
}

bool is_small(const std::filesystem::path& picture) {
  const PictureReader reader(picture);
  return static_cast<long>(reader.facts().width) * reader.facts().height <= most_texels;
}

void make_and_read_again(const Input& input) {
  const TempFolder folder("/dev/shm");
  const std::filesystem::path picture = folder.path() / (std::string("in") + ending_of(input.picture));
  std::ofstream(picture, std::ios::binary) << input.picture;
  if (!is_small(picture)) return;
  const SsbumpRunOptions options = parsed(input.flags, folder.path(), picture);
  ProgressOptions quiet;
  quiet.style = ProgressOptions::Style::off;
  Progress progress("fuzz", quiet);
  (void)run_ssbump(options, progress);
  try {
    if (!options.output.ao_only) (void)read_ssbump(options.output.file, {});
  } catch (const Error&) {
    std::abort();  // what can be written can be read
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  log::init(-1, log::Format::text);
  return 0;
}

/// The library keeps the text of a refused picture's error.
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier,cert-dcl*)
  return "leak:libOpenImageIO";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    make_and_read_again(taken_apart(data, size));
  } catch (const Error&) {
  } catch (const CLI::ParseError&) {
  }
  return 0;
}
