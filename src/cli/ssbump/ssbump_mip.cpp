#include "base/error.h"
#include "base/log.h"
#include "base/text.h"
#include "cli/ssbump/ssbump_tool_flags.h"
#include "cli/ssbump/ssbump_tools.h"
#include "ssbump/map/mips.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

struct MipOptions {
  SsbumpInputFlags input;
  SsbumpOutputFlags output;
  int levels = 0;
};

/// wall.png -> wall.mip3.png.
std::filesystem::path level_file(const std::filesystem::path& file, int level) {
  std::filesystem::path name = file.stem();
  name += fmt::format(".mip{}", level);
  name += file.extension();
  return file.parent_path() / name;
}

int run_mip(const MipOptions& options) {
  SsbumpPicture picture = options.input.read();
  SsbumpOutput output = options.output.output(encoding_of(picture.metadata));
  const std::filesystem::path file = output.file;
  const int all = mip_levels(picture.weights.width(), picture.weights.height());
  const int levels = options.levels > 0 ? std::min(options.levels, all) : all;
  std::vector<std::unique_ptr<SsbumpFile>> files;
  for (int level = 1; level <= levels; ++level) {
    picture.weights = half_size(picture.weights);
    output.file = level_file(file, level);
    const FloatImage& weights = picture.weights;
    auto& written = files.emplace_back(
        std::make_unique<SsbumpFile>(output, picture.metadata, weights.width(), weights.height()));
    written->write(0, weights);
  }
  for (const auto& written : files) written->commit();
  if (levels == 0) log::warn("{}: one texel has no smaller levels", options.input.file.string());
  if (levels > 0) {
    log::info("{} to {}: {}", level_file(file, 1).string(), level_file(file, levels).filename().string(),
              counted(static_cast<std::size_t>(levels), "level"));
  }
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

std::function<int()> add_ssbump_mip(CLI::App& ssbump) {
  auto options = std::make_shared<MipOptions>();
  CLI::App* command =
      ssbump.add_subcommand("mip", "The smaller levels of a map: OUT.mip1.png, OUT.mip2.png, ...");
  options->input.add_to(*command);
  options->output.add_to(*command);
  command->add_option("--levels", options->levels, "how many; 0: down to one texel [0]")
      ->check(CLI::Range(0, 32).description(""))
      ->type_name("N");
  return [options] { return run_mip(*options); };
}

}  // namespace rnmbake
