#include "cli/flags/help_format.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace rnmbake {

namespace {

std::string names_of(const CLI::Option* option) {
  std::string names;
  for (const std::string& name : option->get_snames()) names += "-" + name + ", ";
  const auto& negated = option->get_fnames();
  for (const std::string& name : option->get_lnames()) {
    if (std::find(negated.begin(), negated.end(), name) != negated.end()) continue;
    names += (negated.empty() ? "--" : "--[no-]") + name + ", ";
  }
  return names.substr(0, names.size() - 2);
}

/// One entry of a list: `left`, then the lines of `right` from column `indent` on; below where `left` is
/// long. CLI11 had a helper for it that newer releases no longer have.
std::string row(std::string left, const std::string& right, std::size_t indent) {
  left.insert(0, "  ");
  if (left.size() >= indent) left += "\n";
  std::string out = left;
  out.append(left.back() == '\n' ? indent : indent - left.size(), ' ');
  for (const char letter : right) {
    out += letter;
    if (letter == '\n') out.append(indent, ' ');
  }
  return out + "\n";
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string word, out;
  std::size_t used = 0;
  while (words >> word) {
    if (used > 0 && used + 1 + word.size() > width) {
      out += '\n';
      used = 0;
    } else if (used > 0) {
      out += ' ';
      ++used;
    }
    out += word;
    used += word.size();
  }
  return out;
}

std::string HelpFormat::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  std::string help = CLI::Formatter::make_help(app, std::move(name), mode);
  if (const auto usage = help.find("\nUsage:"); usage != std::string::npos) help.insert(usage, "\n");
  for (auto gap = help.find("\n\n\n"); gap != std::string::npos; gap = help.find("\n\n\n"))
    help.erase(gap, 1);
  return help;
}

/// In the list of commands the first line of a description is enough.
std::string HelpFormat::make_subcommand(const CLI::App* command) const {
  const std::string about = command->get_description();
  return row(command->get_name(), about.substr(0, about.find('\n')), left_column);
}

std::string HelpFormat::make_option(const CLI::Option* option, bool is_positional) const {
  const std::string name = is_positional ? option->get_name(true) : names_of(option);
  return row("  " + name + (is_positional ? "" : make_option_opts(option)),
             wrapped(option->get_description(), columns - left_column), left_column);
}

std::string HelpFormat::make_option_opts(const CLI::Option* option) const {
  return option->get_type_name().empty() ? "" : " " + option->get_type_name();
}

}  // namespace rnmbake
