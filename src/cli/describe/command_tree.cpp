#include "cli/describe/command_tree.h"

#include "config/settings.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

bool holds_capitals(const std::string& word) {
  return std::ranges::any_of(word, [](unsigned char letter) { return std::isupper(letter) != 0; });
}

/// Endings that a help text names: ".blend" of "scene (.blend, .glb)". A list that goes on ("...") limits
/// nothing.
std::vector<std::string> endings_in(const std::string& help) {
  static const std::regex ending(R"((^|[ (])(\.[a-z][a-z0-9]+))");
  std::vector<std::string> found;
  if (help.find("...") != std::string::npos) return found;
  for (std::sregex_iterator at(help.begin(), help.end(), ending), end; at != end; ++at) {
    std::string one = (*at)[2];
    if (std::ranges::find(found, one) == found.end()) found.push_back(std::move(one));
  }
  return found;
}

/// The setting that a flag of the table belongs to.
const Setting* setting_of(const CLI::Option& option) {
  for (const std::string& name : option.get_lnames()) {
    for (const Setting& setting : settings()) {
      if (setting.flag() == "--" + name) return &setting;
    }
  }
  return nullptr;
}

/// Types are written as what may stand there: words in lower case are meant, names in capitals stand for
/// something (sky|area, random|SCENE, DIR).
ValueHint hint_of(const CLI::Option& option, const std::string& type) {
  static const std::vector<std::string> files{"FILE",  "FILE,...", "PATH",   "PROGRAM", "LIGHTMAPS",
                                              "SCENE", "HIGH",     "LOW...", "PROBE"};
  ValueHint hint;
  hint.is_list = option.get_delimiter() != '\0';
  std::istringstream words(type);
  for (std::string word; std::getline(words, word, '|');) {
    if (word.empty() || word == "N") continue;
    if (!holds_capitals(word)) hint.choices.push_back(word);
    if (std::ranges::find(files, word) != files.end()) hint.files = true;
    if (word.starts_with("FILE.")) {
      hint.files = true;
      hint.endings.push_back(word.substr(4));
    }
    if (word == "DIR") hint.folders = true;
  }
  if (type == "CHOICE") {
    if (const Setting* setting = setting_of(option))
      hint.choices.assign(setting->choices.begin(), setting->choices.end());
  }
  const bool is_named = option.get_positional() && type != "NAME" && hint.choices.empty();
  if (is_named) hint.files = true;
  if (hint.files && hint.endings.empty()) hint.endings = endings_in(option.get_description());
  return hint;
}

FlagEntry entry_of(const CLI::Option& option) {
  FlagEntry entry;
  entry.help = option.get_description();
  entry.group = option.get_group();
  entry.repeats = option.get_items_expected_max() > 1;
  const bool takes_value = option.get_items_expected_max() > 0;
  if (takes_value) entry.value = option.get_type_name().empty() ? "VALUE" : option.get_type_name();
  if (option.get_positional()) {
    entry.names.push_back(option.get_name(true));
    entry.value.clear();
  } else {
    for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
    const auto& negated = option.get_fnames();  // those are among the long names, too; they go last
    std::ranges::stable_partition(entry.names, [&](const std::string& name) {
      return std::ranges::none_of(negated, [&](const std::string& one) { return name == "--" + one; });
    });
  }
  if (takes_value) entry.hint = hint_of(option, option.get_type_name());
  return entry;
}

CommandEntry describe_below(const CLI::App& app, std::vector<std::string> path) {
  CommandEntry entry;
  entry.path = std::move(path);
  const std::string text = app.get_description();
  const auto gap = text.find("\n\n");
  entry.summary = text.substr(0, gap);
  if (gap != std::string::npos) entry.about = text.substr(gap + 2);
  entry.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // hidden
    (option->get_positional() ? entry.arguments : entry.flags).push_back(entry_of(*option));
  }
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    std::vector<std::string> below = entry.path;
    below.push_back(command->get_name());
    entry.commands.push_back(describe_below(*command, std::move(below)));
  }
  return entry;
}

void collect(const CommandEntry& command, std::vector<const CommandEntry*>& all) {
  all.push_back(&command);
  for (const CommandEntry& below : command.commands) collect(below, all);
}

}  // namespace

CommandEntry describe_commands(const CLI::App& app) {
  return describe_below(app, {});
}

std::vector<const CommandEntry*> all_commands(const CommandEntry& program) {
  std::vector<const CommandEntry*> all;
  collect(program, all);
  return all;
}

std::vector<FlagEntry> flags_in(const CommandEntry& program, const CommandEntry& command) {
  std::vector<FlagEntry> flags = command.flags;
  if (command.path.empty()) return flags;
  for (const FlagEntry& flag : program.flags) {
    const bool its_own = std::ranges::any_of(
        command.flags, [&](const FlagEntry& one) { return one.names.back() == flag.names.back(); });
    if (!its_own && flag.names.back() != "--version") flags.push_back(flag);
  }
  return flags;
}

}  // namespace rnmbake
