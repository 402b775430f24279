#include "cli/describe/completion.h"

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

std::string fish_quoted(const std::string& text) {
  std::string out = "'";
  for (const char letter : text) {
    if (letter == '\'' || letter == '\\') out += '\\';
    out += letter == '\n' ? ' ' : letter;
  }
  return out + "'";
}

/// "__rnmbake_at ssbump info".
std::string condition(const CommandEntry& command) {
  return fmt::format("'__rnmbake_at {}'", fmt::join(command.path, " "));
}

std::string fish_place(const ValueHint& hint) {
  std::vector<std::string> words;
  if (!hint.choices.empty() && hint.is_list) {
    words.push_back(fmt::format("(__fish_append , {})", fmt::join(hint.choices, " ")));
  } else {
    words = hint.choices;
  }
  if (hint.files)
    words.push_back(fmt::format(
        "(__rnmbake_files{})", hint.endings.empty() ? "" : fmt::format(" {}", fmt::join(hint.endings, " "))));
  if (hint.folders) words.emplace_back("(__fish_complete_directories)");
  return fmt::format("{}", fmt::join(words, " "));
}

std::string fish_flag(const CommandEntry& command, const FlagEntry& flag) {
  std::string names;
  for (const std::string& name : flag.names)
    names += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  std::string line = fmt::format("complete -c rnmbake -n {}{}", condition(command), names);
  if (!flag.value.empty()) line += " -x";
  if (const std::string place = fish_place(flag.hint); !place.empty())
    line += fmt::format(" -a {}", fish_quoted(place));
  return fmt::format("{} -d {}\n", line, fish_quoted(flag.help));
}

/// The case of a switch in __rnmbake_path that knows which words are commands, and which flags have a value.
std::string fish_command(const CommandEntry& program, const CommandEntry& command) {
  std::vector<std::string> names, valued;
  for (const CommandEntry& below : command.commands) names.push_back(below.name());
  for (const FlagEntry& flag : flags_in(program, command)) {
    if (!flag.value.empty()) valued.insert(valued.end(), flag.names.begin(), flag.names.end());
  }
  return fmt::format(
      "            case '{}'\n                set commands {}\n                set valued {}\n",
      fmt::join(command.path, " "), fmt::join(names, " "), fmt::join(valued, " "));
}

}  // namespace

std::string fish_completion(const CommandEntry& program) {
  std::string out =
      "# fish completion of rnmbake; made by `rnmbake completion fish`.\n"
      "complete -c rnmbake -f\n\n"
      "# The commands that were given so far.\n"
      "function __rnmbake_path\n"
      "    set -l path\n"
      "    set -l skip 0\n"
      "    set -l words (commandline -opc)\n"
      "    for word in $words[2..-1]\n"
      "        set -l commands\n"
      "        set -l valued\n"
      "        switch \"$path\"\n";
  for (const CommandEntry* command : all_commands(program)) out += fish_command(program, *command);
  out +=
      "        end\n"
      "        if test $skip = 1\n"
      "            set skip 0\n"
      "        else if contains -- $word $valued\n"
      "            set skip 1\n"
      "        else if contains -- $word $commands\n"
      "            set path $path $word\n"
      "        end\n"
      "    end\n"
      "    echo \"$path\"\n"
      "end\n\n"
      "# Folders, and files with one of these endings; none: all files.\n"
      "function __rnmbake_files\n"
      "    set -l ending '.*'\n"
      "    if set -q argv[1]\n"
      "        set ending '.*('(string join '|' (string escape --style=regex -- $argv))')'\n"
      "    end\n"
      "    for file in (complete -C '__fish_command_without_completions '(commandline -ct))\n"
      "        set -l name (string split -f 1 \\t -- $file)\n"
      "        string match -qr '/$' -- $name; or string match -qir \"^$ending\\$\" -- $name; and echo "
      "$name\n"
      "    end\n"
      "end\n\n"
      "function __rnmbake_at\n"
      "    test (__rnmbake_path) = \"$argv\"\n"
      "end\n\n";
  for (const CommandEntry* command : all_commands(program)) {
    for (const CommandEntry& below : command->commands)
      out += fmt::format("complete -c rnmbake -n {} -a {} -d {}\n", condition(*command), below.name(),
                         fish_quoted(below.summary));
    for (const FlagEntry& argument : command->arguments) {
      if (const std::string place = fish_place(argument.hint); !place.empty()) {
        out += fmt::format("complete -c rnmbake -n {} -a {}\n", condition(*command), fish_quoted(place));
        break;
      }
    }
    for (const FlagEntry& flag : flags_in(program, *command)) out += fish_flag(*command, flag);
  }
  return out;
}

}  // namespace rnmbake
