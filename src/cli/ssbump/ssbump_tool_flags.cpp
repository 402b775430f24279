#include "cli/ssbump/ssbump_tool_flags.h"

#include "base/error.h"

#include <CLI/CLI.hpp>

namespace rnmbake {

SsbumpBits bits_named(const std::string& text) {
  if (text.empty()) return SsbumpBits::chosen_by_ending;
  if (text == "8") return SsbumpBits::eight;
  return text == "16" ? SsbumpBits::sixteen : SsbumpBits::floats;
}

void SsbumpInputFlags::add_to(CLI::App& command, const char* what) {
  command.add_option("map", file, what)->required()->type_name("FILE");
  command.add_option("--scale", scale, "of a map that does not say: what the open surface stores [third]")
      ->check(CLI::IsMember({"third", "ndotb", "mod2x"}).description(""))
      ->type_name("third|ndotb|mod2x");
  command.add_option("--handed", handed, "of a map that does not say: y up (right) or down (left) [right]")
      ->check(CLI::IsMember({"right", "left"}).description(""))
      ->type_name("right|left");
  command.add_option("--alpha", alpha, "of a map that does not say: what its fourth channel holds [none]")
      ->check(CLI::IsMember({"none", "up", "ao"}).description(""))
      ->type_name("none|up|ao");
}

SsbumpHints SsbumpInputFlags::hints() const {
  return {scale_named(scale), handed_named(handed), alpha_named(alpha)};
}

void SsbumpOutputFlags::add_to(CLI::App& command, bool with_dither) {
  command.add_option("-o,--output", file, "what to write: .png, .tga, .tif or .exr")->type_name("FILE");
  command.add_option("--bits", bits, "8, 16 or float [8; float for .exr, where 16 is half]")
      ->check(CLI::IsMember({"8", "16", "float"}).description(""))
      ->type_name("8|16|float");
  if (!with_dither) return;
  command.add_flag("--dither,!--no-dither", dither, "8 bits rounded by chance, without bands [on]");
}

SsbumpOutput SsbumpOutputFlags::output(const SsbumpEncoding& encoding) const {
  if (file.empty()) fail(ExitCode::usage, "nowhere to write to; pass -o FILE.png, .tga, .tif or .exr");
  SsbumpOutput output;
  output.file = file;
  output.encoding = encoding;
  output.bits = bits_named(bits);
  output.dither = dither;
  (void)storage_of(output.file, output.bits);
  return output;
}

}  // namespace rnmbake
