#include "base/error.h"
#include "base/text.h"
#include "cli/bases/basis_file.h"
#include "cli/ssbump/ssbump_flags.h"
#include "encoding/direction_sets.h"

#include <string>
#include <utility>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

BasisSet set_of_words(const std::string& words) {
  if (words == "rnm") return flat_and_rnm();
  if (auto set = direction_set(words)) return std::move(*set);
  if (!std::filesystem::exists(words))
    fail(ExitCode::usage, "--basis-set {} is no set and no file; give rnm, l1, h6, sg, sh3 or a basis file",
         words);
  BasisSet set = read_basis_set(words);
  set.name = std::filesystem::path(words).filename().string();
  return set;
}

}  // namespace

void SsbumpFlags::add_direction_flags(CLI::App& command) {
  command
      .add_option(
          "--basis-set", basis_set_,
          "weights for the lightmaps of that set (rnmbake bake --basis-set or --basis) instead of the "
          "three axes; traced, into an .exr with a channel for each direction")
      ->type_name("rnm|l1|h6|sg|sh3|FILE");
  command
      .add_option(
          "--fit", fit_,
          "with --basis-set: free: least squares; positive: the same without weights below 0, less sharp "
          "[free]")
      ->check(CLI::IsMember({"free", "positive"}).description(""))
      ->needs(command.get_option("--basis-set"))
      ->type_name("free|positive");
}

std::optional<DirectionOptions> SsbumpFlags::direction_options() const {
  if (basis_set_.empty()) return std::nullopt;
  const auto refuse = [&](bool is_given, const char* flag, const char* remedy) {
    if (is_given) fail(ExitCode::usage, "{} does not go with --basis-set {}; {}", flag, basis_set_, remedy);
  };
  refuse(from_mesh(), "--from-mesh", "give a height map");
  refuse(!method_.empty() && method_ != "trace", ("--method " + method_).c_str(),
         "its weights are traced: leave out --method, and set --rays");
  refuse(run_.generate.azimuths != 0, "--azimuths", "set --rays");
  refuse(run_.generate.bounces > 0, "--bounces", "leave it out");
  refuse(!run_.albedo.empty(), "--albedo", "multiply the albedo in the shader");
  refuse(run_.generate.power != 1, "--power", "leave it out: the fit decides how sharp the weights are");
  refuse(alpha_ != "none" || alpha_ao_ || run_.output.ao_only, "ambient occlusion or --alpha",
         "make such a map beside it, without --basis-set");
  refuse(bits_ == "8", "--bits 8", "its weights may be below 0: give 16 or float");
  refuse(scale_ != "third", "--scale", "its weights are for lightmaps as they are baked");
  refuse(handed_ != "right", "--handed left",
         "the map is right-handed, and decode turns it for lightmaps with y down");
  if (lower_extension(run_.output.file) != ".exr")
    fail(ExitCode::usage,
         "cannot write {}: weights of directions may be below 0 and above 1; give -o FILE.exr",
         run_.output.file.string());
  return DirectionOptions{set_of_words(basis_set_), fit_ == "free" ? WeightSign::free : WeightSign::positive,
                          run_.generate.rays, run_.generate.seed, run_.generate.threads};
}

}  // namespace rnmbake
