// project_seeds FOLDER: project and basis files from which fuzzing starts.
#include "base/files.h"
#include "config/document.h"
#include "config/project_file.h"
#include "config/resolve.h"

#include <cstdio>
#include <filesystem>

int main(int argc, char** argv) {
  using namespace rnmbake;
  if (argc != 2) {
    std::fprintf(stderr, "usage: project_seeds FOLDER\n");
    return 1;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const ResolvedConfig usual = resolve(ProjectFile{}, {}, {});
  write_atomically(folder / "everything", print_config(usual, Purpose::bake));
  write_atomically(folder / "overrides",
                   "[scene]\nfile = 'a.blend'\n[[override]]\nobjects = [\"floor*\", \"w[ab]?\"]\n"
                   "resolution = 1_024\nclamp = 1e3\n[[override]]\nobjects = 'x'\nflip_green = true\n");
  write_atomically(folder / "basis",
                   "[[basis]]\nname = \"up\"\ndirection = [0, 0.0, 1]\n[[basis]]\nname = '''side'''\n"
                   "direction = [1.0, 0, .5]\n");
  write_atomically(folder / "dotted", "scene.file = \"\\u0061.blend\"\nbake = {samples = 0x10, uv = \"\"}\n");
  return 0;
}
