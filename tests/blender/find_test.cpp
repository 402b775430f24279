#include "blender/find.h"

#include "blender/fixture.h"

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

/// Sets an environment variable for one test.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (before_) {
      ::setenv(name_, before_->c_str(), 1);
    } else {
      ::unsetenv(name_);
    }
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST(FindBlender, FlagThenVariableThenPath) {
  const TempFolder folder;
  const fs::path by_flag = shell_script(folder.path() / "by_flag", "true");
  const fs::path by_variable = shell_script(folder.path() / "by_variable", "true");
  const fs::path in_path = shell_script(folder.path() / "blender", "true");
  const Variable path("PATH", "/nowhere:" + folder.path().string() + ":/usr/bin:/bin");
  {
    const Variable variable("RNMBAKE_BLENDER", by_variable.string());
    EXPECT_EQ(find_blender(by_flag.string()), by_flag);
    EXPECT_EQ(find_blender("by_flag"), by_flag) << "a bare name is looked up in PATH";
    EXPECT_EQ(find_blender(), by_variable);
  }
  const Variable none("RNMBAKE_BLENDER", "");
  EXPECT_EQ(find_blender(), in_path);
  EXPECT_EQ(find_blender(folder.path().string()), in_path) << "the folder of an unpacked release";
}

TEST(FindBlender, UsualPlacesComeLast) {
  const TempFolder home;
  fs::create_directories(home.path() / "blender-4.2.1-linux-x64");
  const fs::path release = shell_script(home.path() / "blender-4.2.1-linux-x64" / "blender", "true");
  const Variable path("PATH", "/nowhere"), none("RNMBAKE_BLENDER", ""),
      variable("HOME", home.path().string());
  const fs::path found = find_blender();
  const bool installed = found == "/usr/bin/blender" || found == "/usr/local/bin/blender" ||
                         found.string().rfind("/opt/", 0) == 0 || found.string().rfind("/snap/", 0) == 0;
  EXPECT_TRUE(installed || found == release) << found;
}

TEST(FindBlender, WhatIsNamedIsNotPassedOver) {
  const Variable variable("RNMBAKE_BLENDER", "/nowhere/blender");
  const std::string by_flag = message_of([] { find_blender("/no/such/blender"); }, ExitCode::environment);
  EXPECT_TRUE(holds(by_flag, "--blender: there is no /no/such/blender")) << by_flag;
  const std::string by_variable = message_of([] { find_blender(); }, ExitCode::environment);
  EXPECT_TRUE(holds(by_variable, "RNMBAKE_BLENDER")) << by_variable;
  EXPECT_TRUE(holds(message_of([] { find_blender("/etc/passwd"); }, ExitCode::environment), "not a program"));
}

}  // namespace
}  // namespace rnmbake
