#include "cli/app.h"

#include "base/error.h"
#include "base/events/log_event.h"
#include "base/log.h"
#include "base/names.h"
#include "base/version.h"
#include "blender/blender_session.h"
#include "cli/bake.h"
#include "cli/cache.h"
#include "cli/compare.h"
#include "cli/completion.h"
#include "cli/convert.h"
#include "cli/decode.h"
#include "cli/doctor.h"
#include "cli/export.h"
#include "cli/farm/farm.h"
#include "cli/farm/queue.h"
#include "cli/flags/help_format.h"
#include "cli/inspect.h"
#include "cli/probes.h"
#include "cli/reference.h"
#include "cli/render.h"
#include "cli/shaders.h"
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

constexpr const char* purpose =
    "rnmbake bakes the light of a Blender or glTF scene into directional lightmaps: for each\n"
    "object one EXR with the plain lightmap and the three maps of the Half-Life 2 basis (radiosity\n"
    "normal maps), from which an engine lights normal-mapped surfaces. Blender's Cycles does the\n"
    "tracing, headless; the encoding is exact, and every file says in its header what it holds.\n"
    "A path tracer of its own tells how exact.";

constexpr const char* examples =
    "Examples:\n"
    "  rnmbake doctor                                   is there a Blender that can bake?\n"
    "  rnmbake inspect hall.blend                       what would be baked, at which size\n"
    "  rnmbake bake hall.blend -o lightmaps             bake everything\n"
    "  rnmbake bake hall.toml --samples 64              a project file, with one setting changed\n"
    "  rnmbake validate hall.blend -o proof             how wrong is the bake, and why?\n"
    "  rnmbake reference hall.blend -o truth            what the lightmaps should hold, traced\n"
    "  rnmbake compare lightmaps truth -o report        how far apart are the two?\n"
    "  rnmbake render hall.blend --lightmaps lightmaps -o view.png\n"
    "  rnmbake decode lightmaps/floor.exr --normal n.png -o lit.exr\n"
    "  rnmbake ssbump bricks_height.png -o bricks_ssbump.png\n"
    "  rnmbake shaders --engine unity sh2 -o Assets     how a shader decodes it\n"
    "\n"
    "rnmbake COMMAND --help explains a command. Exit codes: 0 ok, 1 usage, 2 file, 3 scene content,\n"
    "4 no usable Blender, 5 unsupported, 6 some objects failed, 7 threshold exceeded, 8 locked.";

constexpr const char* about_bake =
    "\n\nFor every render-enabled object that has faces, Blender bakes the light that arrives along the\n"
    "plain normal and along each vector of the basis; the results are merged into one EXR for each\n"
    "object, beside a manifest.json that says what was baked, how and with what. The scene file itself\n"
    "is never changed. Settings that matter most: --objects, --resolution or --texels-per-unit,\n"
    "--samples, --output.";

constexpr const char* about_inspect =
    "\n\nSays what `rnmbake bake` with the same settings would bake and at which size, and what in the\n"
    "scene would get in its way; nothing is baked or written.";

constexpr const char* about_probes =
    "\n\nLight probes hold the light that reaches a point from all around: what characters and props are\n"
    "lit by, as lightmaps light what stands still. A box of them is filled around the scene, or where\n"
    "Blender's own light probe volumes stand; probes inside of geometry are moved out of it or filled\n"
    "from their neighbours. Writes probes.json and an EXR for each volume: irradiance at 14 normals with\n"
    "standard errors, ambient cube and harmonics of order 3.\n"
    "\n"
    "Examples:\n"
    "  rnmbake probes hall.blend -o volume --spacing 1              a box around the scene\n"
    "  rnmbake probes hall.blend -o volume --bounds 0,0,0,8,6,3     a box of this size\n"
    "  rnmbake probes hall.blend -o volume --dynamic 'Hero*,Door'   without what moves\n"
    "  rnmbake probes hall.blend -o volume --lights static          lamps stay the engine's own";

constexpr const char* about_export =
    "\n\nAlbedo and emission of every surface as Cycles shows them, lights, world, camera and the lightmap\n"
    "UVs, in one .rnmscene file; nothing of the scene is changed. What the reference cannot follow is "
    "listed\n"
    "object by object. --output names the file, or a folder for SCENE.rnmscene.";

constexpr const char* about_reference =
    "\n\nTraces the light itself, without Blender's Cycles: a diffuse path tracer that gives all directions\n"
    "in one pass, without bias and with the standard error of every texel. What it traces is the scene that\n"
    "`bake --materials lambert` bakes; files, names and layers are those of a bake, so every tool takes\n"
    "either. A .rnmscene made by `rnmbake export` needs no Blender.";

constexpr const char* about_validate =
    "\n\nBakes the scene with both recipes, twice each so that the noise is known, traces the truth, and\n"
    "traces the published recipe's faults one after the other. What comes out is one page, DIR/report.html,\n"
    "in which every part of the error has a name, a number and a confidence interval. --samples is the sum\n"
    "over the two halves of a bake.";

constexpr const char* about_compare =
    "\n\nA and B are folders that `rnmbake bake` or `rnmbake reference` wrote, or two lightmaps. Errors are "
    "A\n"
    "minus B, over the texels that both cover; known noise is taken out, and every mean has its 95 %\n"
    "confidence interval. Exit code 7 says that a limit of --fail-above was exceeded.";

constexpr const char* about_convert =
    "\n\nOne bake feeds every encoding: LIGHTMAPS is a folder that `rnmbake bake` wrote, or one lightmap, "
    "and -o "
    "gets\n"
    "the same light in the layers that another decoder expects. `rnmbake decode` and `rnmbake render` read "
    "them "
    "by\n"
    "their headers; docs/convert.md says which encoding loses what.";

constexpr const char* about_ssbump =
    "\n\nStores, for each texel of a height map, how much of the light along each of the three axes of the\n"
    "Half-Life 2 basis arrives past the heights around it. A shader then needs no normal map: light is the\n"
    "sum of channel times lightmap. Height, --wrap and --handed decide what comes out; --alpha up adds a\n"
    "fourth direction. A word in place of INPUT names a tool for maps that are already there.";

constexpr const char* about_nms =
    "\n\nBoris Vorontsov's method (2020): from each texel the normals are walked towards the light, and "
    "where "
    "they\n"
    "rise over its ray there is shadow. No height map is needed, but the normals have to be those of a "
    "surface:\n"
    "--check says how far they are from that.";

constexpr const char* about_shaders =
    "\n\nPrints GLSL or HLSL functions that decode what rnmbake writes: lightmaps in each encoding,\n"
    "self-shadowed bump maps, shadows out of normal maps. --engine says for whom: the language, the file's\n"
    "ending, and functions with the names that its materials have. --engine blender starts Blender and\n"
    "writes a .blend of groups of nodes, one for each encoding.";

constexpr const char* about_cache =
    "\n\nResults of earlier runs that later ones need not make again lie in one folder, under the hash of "
    "all\n"
    "that they were made from: they never grow stale, and deleting any of them costs time alone. --cache, "
    "the\n"
    "variable RNMBAKE_CACHE or `cache` in [run] of a project file name the folder, --cache-limit its size.";

constexpr const char* about_submit =
    "\n\nPlans what `rnmbake bake` with the same settings would bake, and writes it down as tasks that any\n"
    "machine may run which sees the plan, the cache and the scene under the same names. Their results meet "
    "in\n"
    "the cache; a last `rnmbake bake ... --merge PLAN` makes the lightmaps, the same to the last digit as\n"
    "those of one machine. docs/farm.md tells how, for any queue.";

constexpr const char* about_task =
    "\n\nBakes those passes of one task that the cache does not hold, and writes PLAN/tasks/N.json. It may "
    "be\n"
    "killed and run again, or run twice at once. Exit code 6 says that objects failed.";

constexpr const char* about_status =
    "\n\nCounts the files in PLAN/tasks, which are the truth whatever a queue remembers, and says what the\n"
    "queue knows.";

constexpr const char* about_render =
    "\n\nThe view of the scene's camera: albedo times the light that a shader reads from the lightmaps with "
    "the\n"
    "material's normal map, plus what glows, with the world behind. --decode truth traces that light at "
    "each\n"
    "pixel instead, --with cycles asks Blender, and --compare puts all of them side by side on one page.";

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
