#include "cli/compare.h"

#include "base/error.h"
#include "base/log.h"
#include "base/text.h"
#include "cli/flags/command_line.h"
#include "pipeline/compare/compare.h"
#include "pipeline/run/hold_folder.h"
#include "report/thresholds.h"
#include "report/write.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

struct CompareFlags {
  CompareOptions compare;
  std::vector<std::string> objects;
  std::filesystem::path output;
  std::string fail_above;
  bool json = false;
};

std::string command_of(const CompareFlags& options) {
  std::string line = "rnmbake compare";
  const auto add = [&](const char* flag, const std::string& value) {
    if (!value.empty()) line += fmt::format(" {}{}", flag, shell_word(value));
  };
  const CompareOptions& compare = options.compare;
  add("", compare.candidate.path.string());
  add("", compare.reference.path.string());
  add("--second-a ", compare.candidate.second.string());
  add("--second-b ", compare.reference.second.string());
  for (const std::string& glob : options.objects) add("--objects ", glob);
  if (compare.min_validity > 0) line += fmt::format(" --min-validity {:g}", compare.min_validity);
  add("--fail-above ", options.fail_above);
  add("-o ", options.output.string());
  return line;
}

/// Warns of texels with NaN, which count nowhere in the table.
void say_what_is_lost(const Report& report) {
  for (const ObjectComparison& object : report.objects) {
    std::size_t lost = 0;
    for (const BasisMetrics& basis : object.bases) lost = std::max(lost, basis.metrics.non_finite);
    if (lost > 0) log::warn("'{}': left out {} with NaN or infinity", object.key, counted(lost, "texel"));
  }
}

int run_compare(CompareFlags options) {
  std::vector<Threshold> thresholds;
  if (!options.fail_above.empty()) thresholds = parse_thresholds(options.fail_above);
  if (!options.objects.empty()) options.compare.objects = options.objects;
  options.compare.with_maps = !options.output.empty();

  Report report = compare_lightmaps(options.compare);
  say_what_is_lost(report);
  report.title = report.candidate_label + " against " + report.reference_label;
  report.command = command_of(options);
  report.thresholds = check_thresholds(report, std::move(thresholds));
  std::cout << (options.json ? to_json(report) : to_text(report));
  if (!options.output.empty()) {
    const FolderLock lock = hold_folder(options.output);
    write_report(report, options.output);
    log::info("report: {}", (options.output / "report.html").string());
  }
  for (const std::string& line : describe(report.thresholds)) log::error("{}", line);
  return static_cast<int>(report.thresholds.exceeded.empty() ? ExitCode::ok : ExitCode::threshold_exceeded);
}

void add_sides(CLI::App& command, CompareFlags& options) {
  command
      .add_option("a", options.compare.candidate.path,
                  "what is judged: output folder, or one lightmap (.exr)")
      ->required()
      ->type_name("A");
  command.add_option("b", options.compare.reference.path, "what it is held against: the same kind")
      ->required()
      ->type_name("B");
  command
      .add_option("--second-a", options.compare.candidate.second,
                  "A again, baked with another seed: tells noise from error")
      ->type_name("A2");
  command.add_option("--second-b", options.compare.reference.second, "B again, likewise")->type_name("B2");
}

void add_scope(CLI::App& command, CompareFlags& options) {
  command
      .add_option("--objects", options.objects,
                  "compare objects whose key fits this pattern (* ? []) only; may be given again")
      ->type_name("GLOB")
      ->allow_extra_args(false);
  command
      .add_option("--min-validity", options.compare.min_validity,
                  "leave out texels that B's layer 'validity' calls less sound: 0 counts all, 1 only those "
                  "that see no back face [0]")
      ->check(CLI::Range(0.0, 1.0).description(""))
      ->type_name("SHARE");
}

void add_results(CLI::App& command, CompareFlags& options) {
  command.add_option("-o,--output", options.output, "write report.html, report.json and report.csv there")
      ->type_name("DIR");
  command
      .add_option("--fail-above", options.fail_above,
                  "limits for each object and basis, such as rmse=2%,bias=0.5%: exit code 7 where one is "
                  "exceeded. Of rmse, bias, p95, p99, max; % is of B's mean, else E/pi")
      ->type_name("LIMITS");
  command.add_flag("--json", options.json, "print what goes into report.json instead of the table");
}

}  // namespace

std::function<int()> add_compare_command(CLI::App& app) {
  auto options = std::make_shared<CompareFlags>();
  CLI::App* command =
      app.add_subcommand("compare", "How far two sets of lightmaps are from each other, noise taken out");
  add_sides(*command, *options);
  add_scope(*command, *options);
  add_results(*command, *options);
  return [options] { return run_compare(*options); };
}

}  // namespace rnmbake
