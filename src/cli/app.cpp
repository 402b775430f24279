#include "cli/app.h"

#include "base/error.h"
#include "base/events/log_event.h"
#include "base/log.h"
#include "base/names.h"
#include "base/version.h"
#include "blender/blender_session.h"
#include "cli/about.h"
#include "cli/bake.h"
#include "cli/cache.h"
#include "cli/compare.h"
#include "cli/completion.h"
#include "cli/convert.h"
#include "cli/decode.h"
#include "cli/deliver.h"
#include "cli/doctor.h"
#include "cli/export.h"
#include "cli/farm/farm.h"
#include "cli/farm/queue.h"
#include "cli/flags/help_format.h"
#include "cli/inspect.h"
#include "cli/probes.h"
#include "cli/reference.h"
#include "cli/render.h"
#include "cli/shaders/shaders.h"
#include "cli/ssbump/nms.h"
#include "cli/ssbump/ssbump.h"
#include "cli/study.h"
#include "cli/validate.h"
#include "config/variables.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {

namespace {

struct Command {
  const char* name;
  std::function<int()> (*add)(CLI::App&);
  const char* about = "";  // follows the command's own line in its --help
};

const std::vector<Command>& commands() {
  static const std::vector<Command> all{
      {"bake", add_bake_command, about_bake},
      {"inspect", add_inspect_command, about_inspect},
      {"export", add_export_command, about_export},
      {"reference", add_reference_command, about_reference},
      {"probes", add_probes_command, about_probes},
      {"validate", add_validate_command, about_validate},
      {"compare", add_compare_command, about_compare},
      {"render", add_render_command, about_render},
      {"doctor", add_doctor_command},
      {"decode", add_decode_command},
      {"convert", add_convert_command, about_convert},
      {"deliver", add_deliver_command, about_deliver},
      {"study", add_study_command},
      {"ssbump", add_ssbump_command, about_ssbump},
      {"nms", add_nms_command, about_nms},
      {"shaders", add_shaders_command, about_shaders},
      {"cache", add_cache_command, about_cache},
      {"completion", add_completion_command},
      {"man", add_man_command},
      {"submit", add_submit_command, about_submit},
      {"task", add_task_command, about_task},
      {"status", add_status_command, about_status},
      {"wait", add_wait_command},
      {"cancel", add_cancel_command},
  };
  return all;
}

struct GlobalFlags {
  bool quiet = false;
  std::string log_format = "text";
  CLI::Option* verbose = nullptr;

  void add_to(CLI::App& app) {
    app.add_flag("-q,--quiet", quiet, "errors only");
    verbose = app.add_flag("-v,--verbose")->description("say more; twice: everything");
    app.add_option("--log-format", log_format,
                   "diagnostics on stderr as text, or as one JSON object a line (jsonl)")
        ->check(CLI::IsMember({"text", "jsonl"}).description(""))
        ->type_name("text|jsonl");
  }
  void apply() const {
    const int verbosity = quiet ? -1 : static_cast<int>(verbose->count());
    log::init(verbosity, log_format == "jsonl" ? log::Format::jsonl : log::Format::text);
  }
};

/// The command that was given, and the one below it where it has some.
std::vector<CLI::App*> chosen(CLI::App& app) {
  std::vector<CLI::App*> commands;
  for (auto parsed = app.get_subcommands(); !parsed.empty(); parsed = commands.back()->get_subcommands())
    commands.push_back(parsed.front());
  return commands;
}

std::string help_hint(CLI::App& app) {
  std::string words;
  for (const CLI::App* command : chosen(app)) words += command->get_name() + " ";
  return fmt::format("see 'rnmbake {}--help'", words);
}

std::vector<std::string> long_flags(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // hidden
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

[[noreturn]] void unknown_command(const std::string& word) {
  std::vector<std::string> names;
  for (const Command& command : commands()) names.emplace_back(command.name);
  const std::string hint = did_you_mean(word, names);
  fail(ExitCode::usage, "unknown command '{}'{}", word,
       hint.empty() ? fmt::format("; commands are {}", fmt::join(names, ", ")) : hint);
}

/// CLI11 collects what it does not know; an unknown flag is named before the words that followed it.
void refuse_leftovers(CLI::App& app) {
  const std::vector<std::string> left = app.remaining(true);
  const auto is_flag = [](const std::string& word) { return word.size() > 1 && word[0] == '-'; };
  const auto flag = std::find_if(left.begin(), left.end(), is_flag);
  const std::vector<CLI::App*> commands_given = chosen(app);
  if (flag != left.end()) {
    const std::string name = flag->substr(0, flag->find('='));
    std::vector<std::string> known = long_flags(app);
    for (const CLI::App* command : commands_given)
      for (std::string& one : long_flags(*command)) known.push_back(std::move(one));
    const std::string hint = did_you_mean(name, known);
    fail(ExitCode::usage, "unknown flag '{}'{}", name, hint.empty() ? "; " + help_hint(app) : hint);
  }
  if (commands_given.empty() && !left.empty()) unknown_command(left.front());
  if (commands_given.empty()) fail(ExitCode::usage, "no command given; {}", help_hint(app));
  if (!left.empty()) fail(ExitCode::usage, "unexpected argument '{}'; {}", left.front(), help_hint(app));
}

/// CLI11's own words, but for the one message that is not a sentence.
std::string said_plainly(const CLI::ParseError& problem) {
  std::string said = problem.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&problem) == nullptr) return said;
  return fmt::format("flag {} needs a value", said.substr(0, said.find(':')));
}

int parse_and_run(int argc, const char* const* argv) {
  CLI::App app{purpose, "rnmbake"};
  app.formatter(std::make_shared<HelpFormat>());
  app.set_version_flag("--version", std::string("rnmbake ") + version, "show the version and end");
  app.set_help_flag("-h,--help", "show this help and end");
  app.fallthrough()->allow_extras();
  app.require_subcommand(0, 1);
  GlobalFlags globals;
  globals.add_to(app);
  std::vector<std::function<int()>> actions;
  for (const Command& command : commands()) {
    actions.push_back(command.add(app));
    CLI::App* added = app.get_subcommand(command.name);
    added->allow_extras(false)->description(added->get_description() + command.about);
  }
  app.footer(examples);  // after the commands, so that they do not inherit it

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) return app.exit(problem);  // --help, --version
    fail(ExitCode::usage, "{}; {}", said_plainly(problem), help_hint(app));
  }
  globals.apply();
  refuse_leftovers(app);
  refuse_unknown_variables(variables_set());
  for (std::size_t i = 0; i < commands().size(); ++i) {
    if (app.got_subcommand(commands()[i].name)) return actions[i]();
  }
  return static_cast<int>(ExitCode::usage);  // not reached: refuse_leftovers() has seen a command
}

/// Libraries put line breaks into their messages; a diagnostic is one line.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

int end(const std::string& error, int code) {
  log::event(log::Level::error, "end", error, {{"exit_code", std::int64_t(code)}});
  return code;
}

}  // namespace

int run(int argc, const char* const* argv) noexcept {
  try {
    return parse_and_run(argc, argv);
  } catch (const Interrupted& stop) {
    return end("stopped; what was finished before is kept", 128 + stop.signal);
  } catch (const Error& error) {
    return end(one_line(error.what()), static_cast<int>(error.code()));
  } catch (const std::exception& error) {
    return end(one_line(error.what()), static_cast<int>(ExitCode::io));
  }
}

}  // namespace rnmbake
