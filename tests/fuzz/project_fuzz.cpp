// Feeds broken TOML to the readers of project files and basis files: every text is read or refused with an
// Error, and the settings that came of it can be printed and read again. Run by ./dev fuzz project.
#include "base/error.h"
#include "base/files.h"
#include "cli/bases/basis_file.h"
#include "config/document.h"
#include "config/project_file.h"
#include "config/resolve.h"

#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

using namespace rnmbake;

void read_settings(const std::string& text) {
  const ResolvedConfig config = resolve(parse_project(text, "/a/project.toml"), {}, {});
  (void)config.for_object("floor", "hall/floor#1");
  const std::string printed = print_config(config, Purpose::bake);
  try {
    (void)resolve(parse_project(printed, "/a/printed.toml"), {}, {});
  } catch (const Error&) {
    std::abort();  // what is printed is itself a project file
  }
}

void read_basis(const std::string& text) {
  static const TempFolder folder("/dev/shm");
  write_atomically(folder.path() / "basis.toml", text);
  (void)read_basis_file(folder.path() / "basis.toml");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  for (const auto& read : {read_settings, read_basis}) {
    try {
      read(text);
    } catch (const Error&) {
    }
  }
  return 0;
}
