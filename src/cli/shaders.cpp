#include "cli/shaders.h"

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/text_table.h"
#include "shaders/catalogue.h"
#include "shaders/engines.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

struct ShadersOptions {
  std::vector<std::string> names;
  std::string engine = "glsl";
  std::filesystem::path output;
  bool list = false;
};

void write_list() {
  TextTable shaders, engines;
  for (const ShaderFile& file : shader_files()) shaders.add({"  " + file.name, file.purpose});
  for (const ShaderEngine& engine : shader_engines())
    engines.add({"  " + std::string(engine.name), std::string(engine.purpose)});
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
  make_folders(options.output);
  for (const std::string& name : names) {
    const auto file = options.output / fmt::format("rnmbake_{}{}", name, engine.ending);
    write_atomically(file, shader_text(engine, {name}));
    log::info("wrote {}", file.string());
  }
}

int run_shaders(const ShadersOptions& options) {
  const ShaderEngine& engine = engine_named(options.engine);
  if (options.list) {
    write_list();
  } else if (options.output.empty()) {
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
      ->add_option("-o,--output", options->output,
                   "write a file for each NAME into this folder; else all go to stdout as one text")
      ->type_name("DIR");
  command->add_flag("--list", options->list, "say which shaders and engines there are");
  return [options] { return run_shaders(*options); };
}

}  // namespace rnmbake
