#include "pipeline/run/result_store.h"

#include "base/files.h"

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// A variable with another value; nullptr: not set.
class StoreVariable {
 public:
  StoreVariable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    set(value);
  }
  ~StoreVariable() { set(before_ ? before_->c_str() : nullptr); }
  StoreVariable(const StoreVariable&) = delete;
  StoreVariable& operator=(const StoreVariable&) = delete;

 private:
  void set(const char* value) const {
    if (value == nullptr) {
      ::unsetenv(name_);
    } else {
      ::setenv(name_, value, 1);
    }
  }
  const char* name_;
  std::optional<std::string> before_;
};

TEST(CacheFolder, FollowsTheSettingThenXdgThenHome) {
  const StoreVariable home("HOME", "/home/somebody");
  {
    const StoreVariable xdg("XDG_CACHE_HOME", "/var/cache/somebody");
    EXPECT_EQ(cache_folder(""), "/var/cache/somebody/rnmbake");
    EXPECT_EQ(cache_folder("none"), "");
    EXPECT_EQ(cache_folder("/srv/cache"), "/srv/cache");
    EXPECT_EQ(cache_folder("here/../there"), std::filesystem::current_path() / "there");
    EXPECT_EQ(cache_folder("./none"), std::filesystem::current_path() / "none");
  }
  {
    const StoreVariable xdg("XDG_CACHE_HOME", "not/absolute");
    EXPECT_EQ(cache_folder(""), "/home/somebody/.cache/rnmbake");
  }
  const StoreVariable xdg("XDG_CACHE_HOME", nullptr);
  EXPECT_EQ(cache_folder(""), "/home/somebody/.cache/rnmbake");
  const StoreVariable nobody("HOME", nullptr);
  EXPECT_EQ(cache_folder(""), "");
}

TEST(OpenStore, TakesFolderAndLimitFromTheSettings) {
  const TempFolder temp;
  BakeSettings settings;
  settings.run.cache = temp.path() / "cache";
  settings.run.cache_limit = 1;  // MiB
  Store store = open_store(settings);
  const auto key = [](int i) { return KeyMaker().add("i", std::int64_t{i}).make("pass"); };
  for (int i = 0; i < 5; ++i) store.put(key(i), std::string(300'000, 'x'));
  int kept = 0;
  for (int i = 0; i < 5; ++i) kept += store.has(key(i)) ? 1 : 0;
  EXPECT_TRUE(store.has(key(4)));
  EXPECT_LE(kept, 3);
  settings.run.cache = "none";
  EXPECT_FALSE(open_store(settings).keeps());
}

}  // namespace
}  // namespace rnmbake
