#include "cli/shaders/shaders.h"

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/text_table.h"
#include "cli/shaders/shaders_blender.h"
#include "encoding/codecs/make_codec.h"
#include "pipeline/run/hold_folder.h"
#include "shaders/catalogue.h"
#include "shaders/engines.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

struct ShadersOptions {
  std::vector<std::string> names;
  std::string engine = "glsl";
  std::filesystem::path output;
  bool list = false;
  std::string blender;
  bool keep_temporary = false;
};

void write_list() {
  TextTable shaders, engines;
  for (const ShaderFile& file : shader_files()) shaders.add({"  " + file.name, file.purpose});
  for (const ShaderEngine& engine : shader_engines())
    engines.add({"  " + std::string(engine.name), std::string(engine.purpose)});
  engines.add({std::string("  ") + blender_engine,
               fmt::format("Blender: groups of nodes, whose NAMEs are {}", fmt::join(codec_names(), ", "))});
  std::cout << "Shaders:\n";
  shaders.write(std::cout);
  std::cout << "\nEngines:\n";
  engines.write(std::cout);
}

/// A file for each name, with all that it needs.
void write_files(const ShadersOptions& options, const ShaderEngine& engine) {
  std::vector<std::string> names;
  for (const std::string& name : options.names) names.push_back(shader_named(name).name);
  if (names.empty()) names = shaders_of(engine);
  const FolderLock lock = hold_folder(options.output);
  for (const std::string& name : names) {
    const auto file = options.output / fmt::format("rnmbake_{}{}", name, engine.ending);
    write_atomically(file, shader_text(engine, {name}));
    log::info("wrote {}", file.string());
  }
}

int run_shaders(const ShadersOptions& options) {
  if (options.list) {
    write_list();
    return 0;
  }
  if (options.engine == blender_engine) {
    run_shaders_blender(options.names, options.output, options.blender, options.keep_temporary);
    return 0;
  }
  const ShaderEngine& engine = engine_named(options.engine);
  if (options.output.empty()) {
    std::cout << shader_text(engine, options.names);
  } else {
    write_files(options, engine);
  }
  return 0;
}

}  // namespace

std::function<int()> add_shaders_command(CLI::App& app) {
  auto options = std::make_shared<ShadersOptions>();
  CLI::App* command = app.add_subcommand("shaders", "Decoders of every encoding, for shaders of an engine");
  command
      ->add_option("NAME", options->names,
                   "shaders, or encodings as `h6`; with what they need. None: all of them")
      ->type_name("NAME");
  command->add_option("--engine", options->engine, "whose language and names (see --list) [glsl]")
      ->type_name("ENGINE");
  command
      ->add_option(
          "-o,--output", options->output,
          "write a file for each NAME into this folder; else all go to stdout as one text. Of blender one "
          ".blend, in this folder or of this name")
      ->type_name("DIR|FILE");
  command->add_flag("--list", options->list, "say which shaders and engines there are");
  command
      ->add_option("--blender", options->blender,
                   "of --engine blender: Blender to use, a path or a name in PATH [searched]")
      ->type_name("PROGRAM");
  command->add_flag("--keep-temporary", options->keep_temporary,
                    "of --engine blender: leave what Blender was given and gave");
  return [options] { return run_shaders(*options); };
}

}  // namespace rnmbake
