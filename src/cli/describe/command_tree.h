// cli/describe/command_tree.h - commands and flags of the parser as plain data, for completion and manual
// pages.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace rnmbake {

/// What may stand in a place of the command line, as far as its help says.
struct ValueHint {
  std::vector<std::string> choices;
  bool files = false, folders = false;
  std::vector<std::string> endings;  // of files, with their dot; none: any
  bool is_list = false;              // separated by commas

  [[nodiscard]] bool empty() const { return choices.empty() && !files && !folders; }
};

struct FlagEntry {
  std::vector<std::string> names;  // "-o", "--output"; "--repair", "--no-repair"; or the name of an argument
  std::string value;               // "DIR"; "": takes none
  std::string help, group;
  ValueHint hint;
  bool repeats = false;
};

struct CommandEntry {
  std::vector<std::string> path;  // {"ssbump", "info"}; none: the program
  std::string summary;            // its line in the list of commands
  std::string about;              // paragraphs that follow the summary
  std::string footer;             // examples
  std::vector<FlagEntry> flags, arguments;
  std::vector<CommandEntry> commands;

  [[nodiscard]] std::string name() const { return path.empty() ? "rnmbake" : path.back(); }
};

/// Hidden flags are left out.
[[nodiscard]] CommandEntry describe_commands(const CLI::App& app);

/// The program and every command below it, parents first.
[[nodiscard]] std::vector<const CommandEntry*> all_commands(const CommandEntry& program);

/// Flags that count in a command: its own, and those of the program that every command takes.
[[nodiscard]] std::vector<FlagEntry> flags_in(const CommandEntry& program, const CommandEntry& command);

}  // namespace rnmbake
