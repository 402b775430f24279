#include "cli/completion.h"

#include "base/error.h"
#include "base/files.h"
#include "cli/describe/completion.h"
#include "cli/describe/man_page.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

struct ManFlags {
  std::vector<std::string> command;
  std::filesystem::path folder;
};

/// Throws Error(usage) where no command has that name.
const CommandEntry& find_command(const CommandEntry& program, const std::vector<std::string>& path) {
  for (const CommandEntry* one : all_commands(program)) {
    if (one->path == path) return *one;
  }
  fail(ExitCode::usage, "no command '{}' has a manual page; see 'rnmbake --help'", fmt::join(path, " "));
}

void write_pages(const CommandEntry& program, const std::filesystem::path& folder) {
  make_folders(folder);
  for (const CommandEntry* one : all_commands(program))
    write_atomically(folder / (page_name(*one) + ".1"), man_page(program, *one));
}

}  // namespace

std::function<int()> add_completion_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("completion", "Complete command lines of rnmbake: a script for a shell");
  const auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "whose script to print")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}).description(""))
      ->type_name("bash|zsh|fish");
  command->footer(
      "Examples:\n"
      "  source <(rnmbake completion bash)                                   in this shell\n"
      "  rnmbake completion zsh > ~/.zfunc/_rnmbake                          a folder of $fpath\n"
      "  rnmbake completion fish > ~/.config/fish/completions/rnmbake.fish");
  return [&app, shell] {
    const CommandEntry program = describe_commands(app);
    std::cout << (*shell == "bash"  ? bash_completion(program)
                  : *shell == "zsh" ? zsh_completion(program)
                                    : fish_completion(program));
    return static_cast<int>(ExitCode::ok);
  };
}

std::function<int()> add_man_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("man", "The manual page of a command, for man");
  const auto flags = std::make_shared<ManFlags>();
  command->add_option("COMMAND", flags->command, "such as: bake, or: ssbump info; none: rnmbake itself")
      ->type_name("NAME");
  command
      ->add_option("-o,--output", flags->folder, "write the pages of all commands there: rnmbake-bake.1, ...")
      ->type_name("DIR");
  command->footer(
      "Examples:\n"
      "  rnmbake man bake | man -l -\n"
      "  rnmbake man -o ~/.local/share/man/man1");
  return [&app, flags] {
    const CommandEntry program = describe_commands(app);
    if (!flags->folder.empty()) {
      write_pages(program, flags->folder);
    } else {
      std::cout << man_page(program, find_command(program, flags->command));
    }
    return static_cast<int>(ExitCode::ok);
  };
}

}  // namespace rnmbake
