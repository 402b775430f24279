// blender/fixture.h - the installed Blenders, and shell scripts that misbehave as no real one can be asked
// to.
#pragma once

#include "base/error.h"
#include "base/files.h"
#include "blender/find.h"
#include "blender/probe.h"
#include "blender/real_blender.h"

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <gtest/gtest.h>

namespace rnmbake {

inline std::optional<BlenderInfo> installed_blender() {
  try {
    return probe_version(find_blender());
  } catch (const Error&) {
    return std::nullopt;
  }
}

#define REQUIRE_BLENDER(name)                                                 \
  const auto name = installed_blender();                                      \
  if (!name) GTEST_SKIP() << "SKIPPED: no Blender 3.4 or newer is installed"; \
  static_assert(true)

/// An executable shell script.
inline std::filesystem::path shell_script(const std::filesystem::path& path, const std::string& body) {
  write_atomically(path, "#!/bin/sh\n" + body + "\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

inline std::string message_of(const std::function<void()>& action, ExitCode code) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace rnmbake
