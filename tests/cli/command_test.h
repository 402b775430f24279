// tests/cli/command_test.h - a command called as a user does, in this process, with a folder for its files.
#pragma once

#include "base/files.h"
#include "cli/app.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {

class CommandTest : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  /// Runs `rnmbake COMMAND ARGUMENTS`; what it said is in `said_` (stderr) and `printed_` (stdout).
  int call(const char* command, const std::vector<std::string>& arguments) {
    std::vector<const char*> words{"rnmbake", command};
    for (const std::string& argument : arguments) words.push_back(argument.c_str());
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const int code = run(static_cast<int>(words.size()), words.data());
    said_ = testing::internal::GetCapturedStderr();
    printed_ = testing::internal::GetCapturedStdout();
    return code;
  }
  [[nodiscard]] bool said(const std::string& part) const { return said_.find(part) != std::string::npos; }

  TempFolder folder_;
  std::string said_, printed_;
};

}  // namespace rnmbake
