#include "cli/describe/completion.h"

#include <algorithm>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

constexpr const char* zsh_head =
    "#compdef rnmbake\n"
    "# zsh completion of rnmbake; made by `rnmbake completion zsh`.\n\n";

/// Text within a spec of _arguments or _describe.
std::string spec_text(const std::string& text, const char* special) {
  std::string out;
  for (const char letter : text) {
    if (std::string(special).find(letter) != std::string::npos) out += '\\';
    out += letter == '\n' ? ' ' : letter;
  }
  return out;
}

std::string function_of(const CommandEntry& command) {
  std::string name = "_rnmbake";
  for (const std::string& word : command.path) name += "_" + word;
  std::ranges::replace(name, '-', '_');
  return name;
}

/// ":message:action".
std::string zsh_place(const std::string& message, const ValueHint& hint) {
  // The last brackets are plain files; without them a lone ending would be taken for such a qualifier.
  const std::string glob = fmt::format("(#i)*({})(-.)", fmt::join(hint.endings, "|"));
  std::string action = " ";
  if (!hint.choices.empty() && hint.is_list) {
    action = fmt::format("_sequence compadd - {}", fmt::join(hint.choices, " "));
  } else if (!hint.choices.empty() && hint.files) {
    action = fmt::format("{{compadd {}; _files}}", fmt::join(hint.choices, " "));
  } else if (!hint.choices.empty()) {
    action = fmt::format("({})", fmt::join(hint.choices, " "));
  } else if (hint.files) {
    action = hint.endings.empty() ? "_files" : fmt::format("_files -g \"{}\"", glob);
  } else if (hint.folders) {
    action = "_files -/";
  }
  return fmt::format(":{}:{}", spec_text(message, ":\\"), action);
}

std::string flag_specs(const FlagEntry& flag) {
  std::string out;
  for (const std::string& name : flag.names) {
    std::string spec = "*" + name;
    if (!flag.value.empty()) spec += name.starts_with("--") ? "=" : "+";
    spec += fmt::format("[{}]", spec_text(flag.help, "[]\\"));
    if (!flag.value.empty()) spec += zsh_place(flag.value, flag.hint);
    out += fmt::format(" \\\n    {}", single_quoted(spec));
  }
  return out;
}

std::string zsh_function(const CommandEntry& program, const CommandEntry& command) {
  std::string specs;
  for (const FlagEntry& flag : flags_in(program, command)) specs += flag_specs(flag);
  const bool has_commands = !command.commands.empty();
  // A word in place of a file may name a command below.
  if (has_commands) specs += fmt::format(" \\\n    '1: :->first' \\\n    '*:: :->rest'");
  for (const FlagEntry& argument : command.arguments) {
    if (has_commands) break;
    specs += fmt::format(" \\\n    {}", single_quoted((argument.repeats ? "*" : "") +
                                                      zsh_place(argument.names.front(), argument.hint)));
  }
  std::string out = fmt::format(
      "{}() {{\n  local context state state_descr line\n  typeset -A opt_args\n"
      "  _arguments -C -S{}\n",
      function_of(command), specs);
  if (has_commands) {
    out += "  case $state in\n  first)\n    local -a commands=(";
    for (const CommandEntry& below : command.commands)
      out += fmt::format("\n      {}", single_quoted(below.name() + ":" + spec_text(below.summary, ":\\")));
    out += "\n    )\n    _describe -t commands command commands\n";
    if (!command.arguments.empty()) {
      const std::string place =
          zsh_place(command.arguments.front().names.front(), command.arguments.front().hint);
      out += fmt::format("    {}\n", place.substr(place.rfind(':') + 1));
    }
    out += "    ;;\n  rest)\n    case $line[1] in\n";
    for (const CommandEntry& below : command.commands)
      out += fmt::format("    {}) {} ;;\n", below.name(), function_of(below));
    out += "    esac\n    ;;\n  esac\n";
  }
  return out + "}\n\n";
}

}  // namespace

std::string single_quoted(const std::string& text) {
  std::string out = "'";
  for (const char letter : text) out += letter == '\'' ? "'\\''" : std::string(1, letter);
  return out + "'";
}

std::string zsh_completion(const CommandEntry& program) {
  std::string out = zsh_head;
  for (const CommandEntry* command : all_commands(program)) out += zsh_function(program, *command);
  return out + "_rnmbake \"$@\"\n";
}

}  // namespace rnmbake
