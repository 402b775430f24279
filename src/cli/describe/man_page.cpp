#include "cli/describe/man_page.h"

#include "base/version.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

/// Text of a page: hyphens that are minus signs, backslashes, lines that roff would take for requests.
std::string roff(const std::string& text) {
  std::string out;
  bool line_starts = true;
  for (const char letter : text) {
    if (line_starts && (letter == '.' || letter == '\'')) out += "\\&";
    if (letter == '\\') {
      out += "\\e";
    } else if (letter == '-') {
      out += "\\-";
    } else {
      out += letter;
    }
    line_starts = letter == '\n';
  }
  return out;
}

/// "exr|hdr|png", which may go on in another line behind each bar.
std::string choices(const std::string& value) {
  std::string out;
  for (const char letter : roff(value)) out += letter == '|' ? "|\\:" : std::string(1, letter);
  return out;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char letter) { return std::toupper(letter); });
  return text;
}

/// Lines as they are: examples, and tables.
std::string verbatim(const std::string& text) {
  std::string out = ".nf\n";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) out += line.empty() ? ".sp\n" : roff(line) + "\n";
  return out + ".fi\n";
}

std::string paragraphs(const std::string& text) {
  std::string out;
  std::size_t at = 0;
  while (at < text.size()) {
    auto end = text.find("\n\n", at);
    if (end == std::string::npos) end = text.size();
    const std::string one = text.substr(at, end - at);
    const bool shown = one.find("\n  ") != std::string::npos;
    if (at > 0) out += ".PP\n";
    out += shown ? verbatim(one) : roff(one) + "\n";
    at = end + 2;
  }
  return out;
}

std::string synopsis(const CommandEntry& command) {
  std::string out = "\\fBrnmbake\\fR";
  for (const std::string& word : command.path) out += " \\fB" + roff(word) + "\\fR";
  if (!command.commands.empty() && command.arguments.empty())
    return out + " \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n";
  for (const FlagEntry& argument : command.arguments)
    out += fmt::format(" [\\fI{}\\fR]{}", roff(argument.names.front()), argument.repeats ? "..." : "");
  return out + " [\\fIOPTIONS\\fR]\n";
}

std::string entry(const FlagEntry& flag, bool is_argument) {
  std::vector<std::string> names;
  for (const std::string& name : flag.names)
    names.push_back(fmt::format("\\f{}{}\\fR", is_argument ? 'I' : 'B', roff(name)));
  const std::string value = flag.value.empty() ? "" : fmt::format(" \\fI{}\\fR", choices(flag.value));
  std::string help = roff(flag.help);
  return fmt::format(".TP\n{}{}\n{}\n", fmt::join(names, ", "), value, help);
}

std::string flag_sections(const CommandEntry& command) {
  std::vector<std::string> groups;
  for (const FlagEntry& flag : command.flags) {
    if (std::ranges::find(groups, flag.group) == groups.end()) groups.push_back(flag.group);
  }
  std::string out;
  for (const std::string& group : groups) {
    if (groups.size() > 1 && group != groups.front()) out += fmt::format(".SS {}\n", roff(group));
    for (const FlagEntry& flag : command.flags) {
      if (flag.group == group) out += entry(flag, false);
    }
  }
  return out;
}

std::string see_also(const CommandEntry& program, const CommandEntry& command) {
  std::vector<std::string> pages;
  if (!command.path.empty()) pages.push_back(page_name(program));
  for (const CommandEntry& below : command.commands) pages.push_back(page_name(below));
  std::string out;
  for (std::size_t i = 0; i < pages.size(); ++i)
    out += fmt::format(".BR {} (1){}\n", roff(pages[i]), i + 1 < pages.size() ? "," : "");
  return out;
}

}  // namespace

std::string page_name(const CommandEntry& command) {
  std::string name = "rnmbake";
  for (const std::string& word : command.path) name += "-" + word;
  return name;
}

std::string man_page(const CommandEntry& program, const CommandEntry& command) {
  const std::string name = page_name(command);
  std::string out = fmt::format(".TH {} 1 \"\" \"rnmbake {}\" \"rnmbake\"\n", roff(upper(name)), version);
  // The program's description is prose; its first words are the purpose.
  const std::string summary =
      command.path.empty() ? "directional lightmaps of Blender and glTF scenes" : command.summary;
  out += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}", roff(name), roff(summary), synopsis(command));
  const std::string about = command.path.empty() ? command.summary + "\n\n" + command.about : command.about;
  out += ".SH DESCRIPTION\n" + (about.empty() ? roff(command.summary) + ".\n" : paragraphs(about));
  if (!command.arguments.empty()) {
    out += ".SH ARGUMENTS\n";
    for (const FlagEntry& argument : command.arguments) out += entry(argument, true);
  }
  out += ".SH OPTIONS\n" + flag_sections(command);
  if (!command.path.empty())
    out += ".PP\nFlags of the program itself, such as \\fB\\-\\-quiet\\fR, may follow the command.\n";
  if (!command.commands.empty()) {
    out += ".SH COMMANDS\n";
    for (const CommandEntry& below : command.commands)
      out += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(below.name()), roff(below.summary));
  }
  if (!command.footer.empty()) out += ".SH NOTES\n" + paragraphs(command.footer);
  return out + ".SH SEE ALSO\n" + see_also(program, command);
}

}  // namespace rnmbake
