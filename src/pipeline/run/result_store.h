// pipeline/run/result_store.h - where the results of a run are kept, by its settings.
#pragma once

#include "config/bake_settings.h"
#include "jobs/store.h"

#include <filesystem>
#include <string>

namespace rnmbake {

/// [run] cache as an absolute path; "" where nothing is to be kept: it is "none", or is not set and this user
/// has neither $XDG_CACHE_HOME nor $HOME.
[[nodiscard]] std::filesystem::path cache_folder(const std::filesystem::path& cache);

/// Of a sandboxed run only where the folder was named: scenes of strangers do not come into the user's own
/// cache. Nothing is made or read before it is used.
[[nodiscard]] Store open_store(const BakeSettings& settings);

/// Hash of this program, for keys of what it computes itself: another build may compute it otherwise.
[[nodiscard]] const std::string& program_hash();

}  // namespace rnmbake
