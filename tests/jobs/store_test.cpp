#include "jobs/store.h"

#include "base/error.h"
#include "jobs/entry.h"
#include "jobs/store_cases.h"
#include "jobs/upkeep.h"

#include <cstdlib>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

using Store_ = StoreCase;

TEST_F(Store_, KeepsAResultUnderItsKey) {
  Store store(cache(), 0);
  EXPECT_EQ(store.get(pass_key(1)), std::nullopt);
  EXPECT_FALSE(fs::exists(cache())) << "made by reading";
  store.put(pass_key(1), "pixels");
  EXPECT_EQ(Store(cache(), 0).get(pass_key(1)), "pixels");
  EXPECT_EQ(store.get(pass_key(2)), std::nullopt);
  store.remove(pass_key(1));
  EXPECT_FALSE(store.has(pass_key(1)));
}

TEST_F(Store_, KeepsEmptyAndBinaryResults) {
  Store store(cache(), 0);
  const std::string all("\n\0\xff rnmbake-result\n", 19);
  store.put(pass_key(1), "");
  store.put(pass_key(2), all);
  EXPECT_EQ(store.get(pass_key(1)), "");
  EXPECT_EQ(store.get(pass_key(2)), all);
}

TEST_F(Store_, KeepsNothingWithoutAFolder) {
  Store store("", 0);
  store.put(pass_key(1), "pixels");
  EXPECT_FALSE(store.has(pass_key(1)));
  EXPECT_EQ(store.get(pass_key(1)), std::nullopt);
  EXPECT_FALSE(store.keeps());
}

TEST_F(Store_, LetsTheFirstOfTwoStay) {
  Store one(cache(), 0), two(cache(), 0);
  one.put(pass_key(1), "first");
  two.put(pass_key(1), "second");
  EXPECT_EQ(two.get(pass_key(1)), "first");
}

/// Harms the one entry, then expects a warning with `why`, and that the entry can be made again.
void expect_made_again(const fs::path& cache, const std::string& bytes, const std::string& why) {
  const ResultKey key = pass_key(1);
  const fs::path file = entry_path(cache, key);
  write_file(file, bytes);
  Store store(cache, 0);
  Said said;
  EXPECT_EQ(store.get(key), std::nullopt) << why;
  EXPECT_EQ(store.get(key), std::nullopt) << why;
  const std::string text = said.take();
  EXPECT_EQ(lines_in(text), 1U) << text;
  EXPECT_NE(text.find(file.string() + ": " + why), std::string::npos) << text;
  EXPECT_NE(text.find("made again"), std::string::npos) << text;
  EXPECT_FALSE(fs::exists(file));
  store.put(key, "pixels");
  EXPECT_EQ(store.get(key), "pixels");
}

struct Harm {
  const char* name;
  std::string (*do_to)(std::string whole);
  const char* why;
};

class HarmedEntry : public testing::TestWithParam<Harm> {};

TEST_P(HarmedEntry, IsNamedRemovedAndMadeAgain) {
  const TempFolder temp;
  Store(temp.path() / "cache", 0).put(pass_key(1), "pixels");
  const std::string whole = read_text(entry_path(temp.path() / "cache", pass_key(1)));
  expect_made_again(temp.path() / "cache", GetParam().do_to(whole), GetParam().why);
}

INSTANTIATE_TEST_SUITE_P(
    , HarmedEntry,
    testing::Values(
        Harm{"empty", [](std::string) { return std::string(); }, "it is empty"},
        Harm{"zeros", [](std::string s) { return std::string(s.size(), '\0'); },
             "it is no result of rnmbake"},
        Harm{"header_cut", [](std::string s) { return s.substr(0, 30); }, "it is cut off within its header"},
        Harm{"cut", [](std::string s) { return s.substr(0, s.size() - 2); }, "it is cut off: 4 of 6 bytes"},
        Harm{"longer", [](std::string s) { return s + "x"; }, "it has 7 bytes, not 6"},
        Harm{"flipped",
             [](std::string s) {
               s.back() ^= 1;
               return s;
             },
             "its bytes are not those that were written"},
        Harm{"foreign", [](std::string) { return std::string("PNG and so on"); },
             "it is no result of rnmbake"},
        Harm{"version",
             [](std::string s) {
               s[15] = '9';
               return s;
             },
             "it is of format 9"},
        Harm{"other_key", [](std::string) { return entry_header(pass_key(2), "pixels") + "pixels"; },
             "it is the result pass/"},
        Harm{"no_length", [](std::string) { return entry_header(pass_key(1), "x").substr(0, 54) + "x y\nx"; },
             "its header cannot be read"}),
    [](const auto& one) { return one.param.name; });

TEST_F(Store_, RemovesWhatIsNoFileWithoutWaitingForIt) {
  Store store(cache(), 0);
  store.put(pass_key(1), "pixels");
  fs::remove(file(pass_key(1)));
  ASSERT_EQ(::mkfifo(file(pass_key(1)).c_str(), 0600), 0);
  Said said;
  EXPECT_EQ(store.get(pass_key(1)), std::nullopt);
  EXPECT_NE(said.take().find("it is no regular file"), std::string::npos);
  EXPECT_FALSE(store.has(pass_key(1)));
}

TEST_F(Store_, MarksAsUsedByTheHour) {
  Store store(cache(), 0);
  store.put(pass_key(1), "pixels");
  set_used(file(pass_key(1)), std::chrono::hours(30));
  (void)store.has(pass_key(1));
  EXPECT_EQ(age_of(file(pass_key(1))).count(), 30);
  (void)store.get(pass_key(1));
  EXPECT_EQ(age_of(file(pass_key(1))).count(), 0);
  const auto before = fs::file_time_type::clock::now() - std::chrono::minutes(30);
  fs::last_write_time(file(pass_key(1)), before);
  (void)store.get(pass_key(1));
  EXPECT_EQ(fs::last_write_time(file(pass_key(1))), before);
}

TEST_F(Store_, RemovesWhatWasNotUsedForLongestDownToNineTenths) {
  const std::string bytes(900, 'x');
  {
    Store store(cache(), 0);
    for (int i = 0; i < 10; ++i) {
      store.put(pass_key(i), bytes);
      set_used(file(pass_key(i)), std::chrono::hours(100 - i));
    }
  }
  const std::int64_t entry = static_cast<std::int64_t>(fs::file_size(file(pass_key(0))));
  Store store(cache(), 10 * entry);
  EXPECT_EQ(store.get(pass_key(0)), bytes);  // used now
  store.put(pass_key(10), bytes);
  EXPECT_TRUE(store.has(pass_key(0)));
  EXPECT_TRUE(store.has(pass_key(10)));
  EXPECT_FALSE(store.has(pass_key(1)));
  EXPECT_FALSE(store.has(pass_key(2)));
  EXPECT_TRUE(store.has(pass_key(3)));
  EXPECT_EQ(list_store(cache()).bytes, 9 * entry);
}

TEST_F(Store_, DoesNotCountAtEachPut) {
  const std::string bytes(900, 'x');
  Store store(cache(), 1'000'000);
  store.put(pass_key(0), bytes);
  for (int i = 1; i < 5; ++i) {  // behind its back
    fs::create_directories(file(pass_key(i)).parent_path());
    write_file(file(pass_key(i)), std::string(900'000, 'x'));
  }
  store.put(pass_key(10), bytes);
  EXPECT_TRUE(store.has(pass_key(1))) << "counted, though nothing said that it should";
  fs::remove(cache() / SizeEstimate::file_name);  // as after an hour
  store.put(pass_key(11), bytes);
  EXPECT_LE(list_store(cache()).bytes, 900'000);
}

TEST_F(Store_, TellsOthersWhatItAdded) {
  const std::string bytes(900, 'x');
  {
    Store store(cache(), 1'000'000);
    for (int i = 0; i < 5; ++i) store.put(pass_key(i), bytes);
  }
  EXPECT_EQ(SizeEstimate(cache(), 1'000'000).bytes(), list_store(cache()).bytes);
}

TEST_F(Store_, LeavesOutWhatTheLimitCannotHold) {
  Store store(cache(), 10'000);
  store.put(pass_key(1), "small");
  Said said;
  store.put(pass_key(2), std::string(9'500, 'x'));
  store.put(pass_key(3), std::string(9'500, 'x'));
  const std::string text = said.take();
  EXPECT_EQ(lines_in(text), 1U) << text;
  EXPECT_NE(text.find("--cache-limit"), std::string::npos) << text;
  EXPECT_TRUE(store.has(pass_key(1)));
  EXPECT_FALSE(store.has(pass_key(2)));
}

TEST_F(Store_, StaysOutOfOtherPeoplesFolders) {
  fs::create_directories(cache());
  write_file(cache() / "holiday.jpg", "picture");
  Store store(cache(), 0);
  Said said;
  store.put(pass_key(1), "pixels");
  store.put(pass_key(2), "pixels");
  const std::string text = said.take();
  EXPECT_EQ(lines_in(text), 1U) << text;
  EXPECT_NE(text.find("no cache of rnmbake"), std::string::npos) << text;
  EXPECT_FALSE(store.has(pass_key(1)));
  EXPECT_FALSE(store.keeps());
}

TEST_F(Store_, LeavesACacheOfAnotherFormatAlone) {
  Store(cache(), 0).put(pass_key(1), "pixels");
  std::string tag = read_text(cache() / "CACHEDIR.TAG");
  tag.replace(tag.find("format 1"), 8, "format 7");
  write_file(cache() / "CACHEDIR.TAG", tag);
  EXPECT_EQ(look_at_store_folder(cache()), StoreFolder::other);
  EXPECT_THROW(trim_store(cache(), {0, {}}), Error);
  Said said;
  Store(cache(), 0).put(pass_key(2), "pixels");
  EXPECT_NE(said.take().find("another version"), std::string::npos);
  EXPECT_FALSE(fs::exists(file(pass_key(2))));
}

TEST_F(Store_, GoesOnWhereItCannotWrite) {
  write_file(cache(), "a file has that name");
  Store store(cache() / "deeper", 1'000'000);
  Said said;
  store.put(pass_key(1), "pixels");
  store.put(pass_key(2), "pixels");
  const std::string text = said.take();
  EXPECT_EQ(lines_in(text), 1U) << text;
  EXPECT_NE(text.find("--cache none"), std::string::npos) << text;
  EXPECT_EQ(store.get(pass_key(1)), std::nullopt);
}

/// A small file system of its own; needs root.
class SmallDisk {
 public:
  SmallDisk(const fs::path& folder, const std::string& options) : folder_(folder) {
    fs::create_directories(folder);
    const std::string mount = "mount -t tmpfs -o " + options + " none " + folder.string() + " 2>/dev/null";
    mounted_ = std::system(mount.c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) (void)!std::system(("umount " + folder_.string()).c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  [[nodiscard]] bool is_there() const { return mounted_; }

 private:
  fs::path folder_;
  bool mounted_ = false;
};

TEST_F(Store_, GivesUpOnAFullDisk) {
  const SmallDisk disk(cache(), "size=1m");
  if (!disk.is_there()) GTEST_SKIP() << "SKIPPED: a small tmpfs needs root";
  Store store(cache(), 0);
  store.put(pass_key(1), "pixels");
  Said said;
  store.put(pass_key(2), std::string(2'000'000, 'x'));
  store.put(pass_key(3), "pixels");
  const std::string text = said.take();
  EXPECT_EQ(lines_in(text), 1U) << text;
  EXPECT_NE(text.find("disk is full"), std::string::npos) << text;
  EXPECT_FALSE(store.has(pass_key(3)));
  EXPECT_EQ(store.get(pass_key(1)), "pixels");
  EXPECT_TRUE(list_store(cache()).temporary.empty());
}

TEST_F(Store_, ReadsWhereItMayNotWrite) {
  Store(cache(), 0).put(pass_key(1), "pixels");
  const fs::path other = temp_.path() / "mounted";
  const SmallDisk disk(other, "size=1m");
  if (!disk.is_there()) GTEST_SKIP() << "SKIPPED: a small tmpfs needs root";
  fs::copy(cache(), other / "cache", fs::copy_options::recursive);
  set_used(entry_path(other / "cache", pass_key(1)), std::chrono::hours(30));
  ASSERT_EQ(std::system(("mount -o remount,ro " + other.string()).c_str()), 0);
  Store store(other / "cache", 0);
  Said said;
  EXPECT_EQ(store.get(pass_key(1)), "pixels");
  store.put(pass_key(2), "pixels");
  store.put(pass_key(3), "pixels");
  const std::string text = said.take();
  EXPECT_EQ(lines_in(text), 1U) << text;
  EXPECT_NE(text.find("Read-only file system"), std::string::npos) << text;
}

}  // namespace
}  // namespace rnmbake
