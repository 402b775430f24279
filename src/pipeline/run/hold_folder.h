// pipeline/run/hold_folder.h - the folder that a command writes to, made and held for its whole run.
#pragma once

#include "jobs/folder_lock.h"

#include <filesystem>

namespace rnmbake {

/// Makes the folder and holds it, waiting so many seconds for another run. Throws Error(io),
/// Error(lock_held), or Interrupted where the user stops the program while it waits.
[[nodiscard]] FolderLock hold_folder(const std::filesystem::path& folder, int wait_seconds = 0);

}  // namespace rnmbake
