// Bakes the closed forms with every given Blender and writes a table of errors: a part of docs/accuracy.md,
// which bench/scene_accuracy.py puts together.
//
//   accuracy --blender 3.4=/usr/bin/blender --blender 4.3=... -o closed_forms.md
#include "base/error.h"
#include "base/files.h"
#include "closed_forms/cases.h"
#include "closed_forms/horizon.h"
#include "closed_forms/workbench.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace rnmbake {
namespace {

struct Recipe {
  std::string title;
  Words flags;
};
const std::vector<Recipe> recipes{
    {"receiver", {}},
    {"flat-normal-map", {"--recipe", "flat-normal-map", "--dispatch", "scene"}},
    {"flat-normal-map --correct-bump",
     {"--recipe", "flat-normal-map", "--dispatch", "scene", "--correct-bump"}},
};

Words joined(Words flags, const Words& more) {
  flags.insert(flags.end(), more.begin(), more.end());
  return flags;
}

std::string cell(const Outcome& outcome) {
  return fmt::format("{:.4f} / {:.4f}", outcome.mean, outcome.expected);
}

/// One version's chapter.
class Chapter {
 public:
  Chapter(std::string label, const std::string& blender)
      : label_(std::move(label)), bench_(RNMBAKE_BINARY, blender) {}

  std::string write() {
    text_ = fmt::format("\n### Blender {} ({})\n", label_, bench_.blender().version_text);
    suns();
    unusual();
    uniform();
    horizon();
    return std::move(text_);
  }

 private:
  template <typename... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    text_ += fmt::format(format, std::forward<Values>(values)...) + "\n";
  }

  /// The plain suns: mean / expected at azimuth 0, and the worst texel of all bases and azimuths.
  void suns() {
    suns_ = bench_.build({"suns", {}});
    for (const Recipe& recipe : recipes) {
      const Baked baked =
          bench_.bake(suns_, joined(joined(sun_flags(), recipe.flags), {"--objects", "sun_*"}));
      line("\nSun, `{}`, mean / expected at azimuth 0:\n", recipe.title);
      line("| sun at | flat | rnm0 | rnm1 | rnm2 | largest error of the mean | of a texel |");
      line("|---|---|---|---|---|---|---|");
      for (const double angle : sun_angles) sun_row(baked, angle);
    }
  }

  void sun_row(const Baked& baked, double angle) {
    std::string row = fmt::format("| {:g} |", angle);
    double of_mean = 0, of_texel = 0;
    for (const int azimuth : sun_azimuths) {
      for (const Outcome& outcome : outcomes(baked, {"", angle, azimuth})) {
        if (azimuth == 0) row += fmt::format(" {} |", cell(outcome));
        of_mean = std::max(of_mean, std::abs(outcome.error()));
        of_texel = std::max(of_texel, outcome.largest);
      }
    }
    line("{} {:.5f} | {:.5f} |", row, of_mean, of_texel);
  }

  static std::vector<Outcome> outcomes(const Baked& baked, const SunCase& sun) {
    return compare(baked.lightmap(sun.object()), [&](const BasisDirection& b) { return sun.truth(b); });
  }

  void unusual() {
    const Baked baked = bench_.bake(suns_, joined(sun_flags(), {"--exclude", "sun_*"}));
    std::vector<std::pair<std::string, double>> worst;
    for (const SunCase& sun : unusual_suns()) {
      if (worst.empty() || worst.back().first != sun.prefix) worst.emplace_back(sun.prefix, 0);
      for (const Outcome& outcome : outcomes(baked, sun))
        worst.back().second = std::max(worst.back().second, outcome.largest);
    }
    line("\nSun at 54.7 and 70 degrees, four azimuths, `receiver`, largest error of a texel:\n");
    line("| planes | error |");
    line("|---|---|");
    for (const auto& [prefix, error] : worst)
      line("| {} | {:.5f} |", prefix.substr(0, prefix.size() - 1), error);
  }

  void uniform() {
    line("\nUniform light, mean / expected; in brackets the largest standard error of the row:\n");
    line("| scene | recipe | flat | rnm0 | rnm1 | rnm2 |");
    line("|---|---|---|---|---|---|");
    for (const UniformCase& form : uniform_cases()) {
      const auto blend = bench_.build(form.scene);
      for (const Recipe& recipe : recipes) {
        const Baked baked =
            bench_.bake(blend, joined(joined(form.flags, recipe.flags), {"--objects", form.object}));
        std::string row;
        double noise = 0;
        for (const Outcome& outcome : compare(baked.lightmap(form.object), form.truth)) {
          row += fmt::format(" {} |", cell(outcome));
          noise = std::max(noise, outcome.standard_error);
        }
        line("| {} ({:.4f}) | `{}` |{}", form.title, noise, recipe.title, row);
      }
    }
  }

  void horizon() {
    line("\nSmooth low-poly solids, `receiver`, texels whose basis normal lies below their face:\n");
    line("| scene | texels | mean of the truth | horizon | mean error | standard error | RMS error |");
    line("|---|---|---|---|---|---|---|");
    for (const HorizonCase& form : horizon_cases()) {
      const auto blend = bench_.build(form.scene);
      const SceneSurvey survey = bench_.survey(blend);
      for (const char* mode : {"identity", "clamp"}) {
        const Baked baked = bench_.bake(blend, joined(horizon_flags(), {"--horizon", mode}));
        const ErrorSummary below =
            compare_horizon(form, survey, baked.lightmap(form.object), footprint_of(bench_.blender().version))
                .below;
        line("| {} | {} | {:.4f} | {} | {:+.4f} | {:.4f} | {:.4f} |", form.title, below.texels, below.truth,
             mode, below.mean, below.standard_error, below.rms);
      }
    }
  }

  std::string label_;
  Workbench bench_;
  std::filesystem::path suns_;
  std::string text_;
};

const char* const introduction = R"(## Closed forms

`./dev accuracy closed-forms` bakes the scenes with a closed form (`scenes/README.md`) through the whole
command line and compares. Values are E/pi; suns have a strength of pi, so that 1 is all they give.
`tests/with_blender/closed_forms_test.cpp` holds the `receiver` recipe to these formulas.

`flat-normal-map` is the published recipe to the letter, its errors included: the tilt clamp of 3.4, bump shadowing,
light that the object sends to itself, light from below. `--correct-bump` turns bump shadowing off where Blender
has the switch (from 4.2 on; nothing changes in 3.4).

A standard error comes from the spread over the texels of one map. Only versions that were there are listed.

What `receiver` leaves, and why:

- Before Blender 4.5 corner normals are angles of 16 bits: some 1e-4 of a sun's irradiance. One whose azimuth lies
  within 0.81 degrees of its triangle's edge is turned into that edge's, up to 0.011; these scenes have no such case.
- Where a ray starts at an edge between two triangles Cycles lifts it by up to 256 float steps of its coordinates. Far
  from the origin (2 mm at 80 m) light from just below a face slips past its open rim there.
- Below the horizon faces are cut into small pieces and samples beyond a piece's edge fold back into it: an error
  that falls with the texel's size (here 64 x 64).
)";

/// A chapter, or one line with the reason why there is none.
std::string chapter(const std::string& label, const std::string& blender) {
  try {
    return Chapter(label, blender).write();
  } catch (const Error& error) {
    return fmt::format("\n### Blender {}\n\nNot measured: {}\n", label, error.what());
  }
}

void write_report(const std::vector<std::string>& blenders, const std::string& output) {
  std::vector<std::future<std::string>> chapters;
  for (const std::string& blender : blenders) {
    const auto equals = blender.find('=');
    if (equals == std::string::npos) fail(ExitCode::usage, "--blender {}: expected VERSION=PATH", blender);
    chapters.push_back(
        std::async(std::launch::async, chapter, blender.substr(0, equals), blender.substr(equals + 1)));
  }
  std::string text = introduction;
  for (auto& one : chapters) text += one.get();
  write_atomically(output, text);
}

}  // namespace
}  // namespace rnmbake

int main(int argc, char** argv) {
  CLI::App app{"Bakes the closed forms and writes what came out"};
  std::vector<std::string> blenders{"default=blender"};
  std::string output = "closed_forms.md";
  app.add_option("--blender", blenders, "VERSION=PATH; may be repeated");
  app.add_option("-o,--output", output, "file to write");
  CLI11_PARSE(app, argc, argv);
  try {
    rnmbake::write_report(blenders, output);
  } catch (const rnmbake::Error& error) {
    std::cerr << "accuracy: " << error.what() << "\n";
    return static_cast<int>(error.code());
  }
  return 0;
}
