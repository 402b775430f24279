#include "cli/doctor.h"

#include "base/error.h"
#include "base/files.h"

#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

TEST(Doctor, SaysWhatIsMissingAndHowToGetIt) {
  DoctorOptions options;
  options.blender = "/nowhere/blender";
  std::ostringstream out;
  EXPECT_EQ(doctor(options, out), static_cast<int>(ExitCode::environment));
  EXPECT_NE(out.str().find("there is no /nowhere/blender"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("apt install blender"), std::string::npos) << out.str();
}

TEST(Doctor, JsonHoldsTheSameFindings) {
  const TempFolder folder;
  const std::filesystem::path old = folder.path() / "blender";
  write_atomically(old, "#!/bin/sh\necho Blender 2.93.1\n");
  std::filesystem::permissions(old, std::filesystem::perms::owner_all);
  DoctorOptions options;
  options.blender = old.string();
  options.json = true;
  std::ostringstream out;
  EXPECT_EQ(doctor(options, out), static_cast<int>(ExitCode::environment));
  const nlohmann::json json = nlohmann::json::parse(out.str());
  EXPECT_EQ(json.at("schema_version"), 1);
  EXPECT_FALSE(json.at("usable"));
  EXPECT_TRUE(json.at("blender").is_null());
  EXPECT_GT(json.at("memory_bytes"), 0);
  EXPECT_NE(json.at("missing").at(0).at("what").get<std::string>().find("2.93.1"), std::string::npos);
}

TEST(Doctor, WithTheInstalledBlender) {
  DoctorOptions options;
  options.json = true;
  std::ostringstream out;
  const int code = doctor(options, out);
  const nlohmann::json json = nlohmann::json::parse(out.str());
  if (!json.at("usable")) {
    EXPECT_EQ(code, static_cast<int>(ExitCode::environment));
    GTEST_SKIP() << "SKIPPED: no Blender 3.4 or newer is installed";
  }
  EXPECT_EQ(code, 0);
  EXPECT_FALSE(json.at("blender").at("devices").empty());
  EXPECT_TRUE(json.at("blender").at("numpy").is_boolean());
}

}  // namespace
}  // namespace rnmbake
