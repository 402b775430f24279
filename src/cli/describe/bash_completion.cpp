#include "cli/describe/completion.h"

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

constexpr const char* bash_head =
    "# bash completion of rnmbake; made by `rnmbake completion bash`.\n"
    "\n"
    "# What a command (its words, each with a space before it) takes: commands below it, flags, those with a "
    "value.\n"
    "_rnmbake_command() {\n"
    "  case $1 in\n";

constexpr const char* bash_middle =
    "    *) return 1 ;;\n"
    "  esac\n"
    "}\n"
    "\n"
    "# What may stand behind a flag of a command; as an argument where the flag is empty.\n"
    "_rnmbake_place() {\n"
    "  case \"$1 $2\" in\n";

constexpr const char* bash_tail = R"bash(  esac
}

_rnmbake_files() {
  local name ending
  compopt -o filenames 2>/dev/null
  while IFS= read -r name; do
    if [[ -d $name || -z $endings ]]; then
      COMPREPLY+=("$name")
      continue
    fi
    for ending in $endings; do
      if [[ ${name,,} == *"$ending" ]]; then COMPREPLY+=("$name"); fi
    done
  done < <(compgen -f -- "$1")
}

_rnmbake_values() {
  local commands='' flags='' valued='' choices='' files='' folders='' endings='' list='' before='' word=$3 one
  _rnmbake_place "$1" "$2"
  if [[ -n $list && $word == *,* ]]; then
    before=${word%,*},
    word=${word##*,}
  fi
  for one in $choices; do
    if [[ $one == "$word"* ]]; then COMPREPLY+=("$before$one"); fi
  done
  if [[ -n $files ]]; then _rnmbake_files "$word"; fi
  if [[ -n $folders ]]; then
    compopt -o filenames 2>/dev/null
    while IFS= read -r one; do COMPREPLY+=("$one"); done < <(compgen -d -- "$word")
  fi
}

_rnmbake() {
  local commands='' flags='' valued='' path='' word previous='' at cur=${COMP_WORDS[COMP_CWORD]} one
  COMPREPLY=()
  _rnmbake_command ''
  for ((at = 1; at < COMP_CWORD; ++at)); do
    word=${COMP_WORDS[at]}
    if [[ $word == '=' ]]; then continue; fi # bash takes --flag=value apart
    if [[ -n $previous ]]; then
      previous=''
    elif [[ $word == -* ]]; then
      if [[ " $valued " == *" $word "* ]]; then previous=$word; fi
    elif [[ " $commands " == *" $word "* ]]; then
      path+=" $word"
      _rnmbake_command "$path"
    fi
  done
  if [[ $cur == '=' ]]; then cur=''; fi
  if [[ -n $previous ]]; then
    _rnmbake_values "$path" "$previous" "$cur"
  elif [[ $cur == -* ]]; then
    for one in $flags; do
      if [[ $one == "$cur"* ]]; then COMPREPLY+=("$one"); fi
    done
  else
    for one in $commands; do
      if [[ $one == "$cur"* ]]; then COMPREPLY+=("$one"); fi
    done
    _rnmbake_values "$path" '' "$cur"
  fi
}

complete -F _rnmbake rnmbake
)bash";

std::string path_of(const CommandEntry& command) {
  std::string path;
  for (const std::string& word : command.path) path += " " + word;
  return path;
}

std::string assignments(const ValueHint& hint) {
  std::string out;
  if (!hint.choices.empty()) out += fmt::format(" choices='{}'", fmt::join(hint.choices, " "));
  if (hint.files) out += " files=1";
  if (hint.folders) out += " folders=1";
  if (!hint.endings.empty()) out += fmt::format(" endings='{}'", fmt::join(hint.endings, " "));
  if (hint.is_list) out += " list=1";
  return out.substr(1);
}

std::string command_case(const CommandEntry& program, const CommandEntry& command) {
  std::vector<std::string> names, flags, valued;
  for (const CommandEntry& below : command.commands) names.push_back(below.name());
  for (const FlagEntry& flag : flags_in(program, command)) {
    flags.insert(flags.end(), flag.names.begin(), flag.names.end());
    if (!flag.value.empty()) valued.insert(valued.end(), flag.names.begin(), flag.names.end());
  }
  return fmt::format("    '{}')\n      commands='{}'\n      flags='{}'\n      valued='{}' ;;\n",
                     path_of(command), fmt::join(names, " "), fmt::join(flags, " "), fmt::join(valued, " "));
}

std::string place_cases(const CommandEntry& program, const CommandEntry& command) {
  std::string out;
  for (const FlagEntry& flag : flags_in(program, command)) {
    if (flag.hint.empty()) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : flag.names)
      patterns.push_back(fmt::format("'{} {}'", path_of(command), name));
    out += fmt::format("    {}) {} ;;\n", fmt::join(patterns, " | "), assignments(flag.hint));
  }
  for (const FlagEntry& argument : command.arguments) {
    if (argument.hint.empty()) continue;
    out += fmt::format("    '{} ') {} ;;\n", path_of(command), assignments(argument.hint));
    break;  // the others of a command take the same
  }
  return out;
}

}  // namespace

std::string bash_completion(const CommandEntry& program) {
  std::string out = bash_head;
  for (const CommandEntry* command : all_commands(program)) out += command_case(program, *command);
  out += bash_middle;
  for (const CommandEntry* command : all_commands(program)) out += place_cases(program, *command);
  return out + bash_tail;
}

}  // namespace rnmbake
