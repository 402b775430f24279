#include "pipeline/run/result_store.h"

#include "base/hash.h"

#include <cstdlib>

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

/// "" unless the variable holds an absolute path: the XDG base directory specification wants others ignored.
fs::path folder_in(const char* variable) {
  const char* text = std::getenv(variable);
  const fs::path folder = text == nullptr ? "" : text;
  return folder.is_absolute() ? folder : fs::path();
}

}  // namespace

fs::path cache_folder(const fs::path& cache) {
  if (cache == no_cache) return {};
  if (!cache.empty()) return fs::absolute(cache).lexically_normal();
  if (const fs::path own = folder_in("XDG_CACHE_HOME"); !own.empty()) return own / "rnmbake";
  const fs::path home = folder_in("HOME");
  return home.empty() ? fs::path() : home / ".cache" / "rnmbake";
}

Store open_store(const BakeSettings& settings) {
  // A script of the scene's own can say that it is another scene, and so leave its light in that one's place.
  const bool is_shared = settings.run.cache.empty();
  const bool keeps_none = settings.run.sandbox && is_shared;
  return Store(keeps_none ? fs::path() : cache_folder(settings.run.cache),
               std::int64_t{settings.run.cache_limit} << 20);
}

const std::string& program_hash() {
  static const std::string hash = file_hash128_hex("/proc/self/exe");
  return hash;
}

}  // namespace rnmbake
