// Says at once that nothing is to be done, where a command is run again and nothing changed; everything else
// is done by rnmbake-engine, whose libraries alone take longer to load than a build wants to wait.
#include "jobs/run_index.h"

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>

#include <unistd.h>

namespace {

namespace fs = std::filesystem;

/// Beside this program, or where `cmake --install` puts it.
fs::path engine() {
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  const fs::path beside = here / "rnmbake-engine";
  return fs::exists(beside) ? beside : here.parent_path() / RNMBAKE_LIBEXEC / "rnmbake-engine";
}

bool is_quiet(std::span<char* const> words) {
  for (const char* word : words) {
    if (std::strcmp(word, "-q") == 0 || std::strcmp(word, "--quiet") == 0) return true;
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  const std::span<char* const> words(argv, static_cast<std::size_t>(argc));
  if (const auto run = rnmbake::unchanged_run({argv, words.size()})) {
    for (const fs::path& record : run->records) {
      if (!is_quiet(words))
        std::fprintf(stderr, "rnmbake: nothing to do: %s is up to date\n", record.parent_path().c_str());
    }
    return 0;
  }
  const fs::path program = engine();
  execv(program.c_str(), argv);
  std::fprintf(stderr, "rnmbake: error: %s cannot be started (%s); install rnmbake again\n", program.c_str(),
               std::strerror(errno));
  return 4;
}
