// Error of what light probes light, and light that leaks between them: the figures of docs/volumes.md, which
// bench/volume_accuracy.py puts there. Prints JSON.
//
//   bench_volumes statue --scene hall.rnmscene --bounds 0,0,0,8,4,3 --spacing 2,1 --at 1,2,1 --at 3,2,1
//   bench_volumes leaks --two-rooms two_rooms.rnmscene --spacing 1.3,1
#include "base/error.h"
#include "volumes/leaks.h"
#include "volumes/lit_statue.h"

#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

Vec3d place_of(const std::string& text) {
  Vec3d place(0);
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf", &place.x, &place.y, &place.z) != 3)
    fail(ExitCode::usage, "--at {}: three numbers are needed, x,y,z", text);
  return place;
}

}  // namespace
}  // namespace rnmbake

int main(int argc, char** argv) {
  using namespace rnmbake;
  CLI::App app("Measures light probes");
  app.require_subcommand(1);
  StatueStudy statue;
  std::string bounds;
  std::vector<std::string> places;
  bool no_lamps = false;
  CLI::App* statues = app.add_subcommand("statue", "a statue at several places of a scene");
  statues->add_option("--scene", statue.scene, ".rnmscene")->required();
  statues->add_option("--at", places, "x,y,z of the statue, once for each place")->required();
  statues->add_option("--bounds", bounds, "of the box of probes")->required();
  statues->add_option("--spacing", statue.spacings)->delimiter(',')->required();
  statues->add_option("--points", statue.points);
  statues->add_option("--samples", statue.samples);
  statues->add_flag("--black", statue.black, "a statue that reflects nothing");
  statues->add_flag("--no-lamps", no_lamps, "as probes --lights static: lamps are the engine's own");
  LeakStudy leak;
  CLI::App* leaks = app.add_subcommand("leaks", "light that comes through walls");
  leaks->add_option("--two-rooms", leak.two_rooms, ".rnmscene; without it the closed cases alone");
  leaks->add_option("--spacing", leak.spacings)->delimiter(',')->required();
  leaks->add_option("--samples", leak.samples);
  CLI11_PARSE(app, argc, argv);
  try {
    if (leaks->parsed()) {
      std::cout << study_leaks(leak).dump(1) << '\n';
      return 0;
    }
    statue.bounds = parse_bounds(bounds);
    statue.direct.lamps = !no_lamps;
    for (const std::string& place : places) statue.places.push_back(place_of(place));
    std::cout << study_statue(statue).dump(1) << '\n';
  } catch (const Error& error) {
    std::cerr << "bench_volumes: " << error.what() << '\n';
    return static_cast<int>(error.code());
  }
  return 0;
}
