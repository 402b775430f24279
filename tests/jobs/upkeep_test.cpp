#include "jobs/upkeep.h"

#include "base/error.h"
#include "base/owner.h"
#include "jobs/store_cases.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

using Upkeep = StoreCase;

/// The owner's word of a process that has ended.
std::string word_of_the_dead() {
  int ends[2];
  EXPECT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    // owner_word() may be known already; the parent's with the child's number is good enough: no such process
    // will do.
    std::string word = owner_word();
    (void)!::write(ends[1], word.data(), word.size());
    ::_exit(0);
  }
  std::string word(256, '\0');
  word.resize(static_cast<std::size_t>(std::max<ssize_t>(0, ::read(ends[0], word.data(), word.size()))));
  ::waitpid(child, nullptr, 0);
  ::close(ends[0]);
  ::close(ends[1]);
  return word.substr(0, word.rfind('-')) + "-1";  // started at another time
}

TEST_F(Upkeep, RefusesAFolderThatIsNoStore) {
  fs::create_directories(cache() / "pass" / "ab");
  write_file(cache() / "pass" / "ab" / "abababababababababababababababab", "not ours");
  EXPECT_THROW(trim_store(cache(), {0, {}}), Error);
  EXPECT_THROW(verify_store(cache()), Error);
  write_file(cache() / "CACHEDIR.TAG", "Signature: 8a477f597d28d172789f06886806bc55\n# of another program\n");
  EXPECT_THROW(trim_store(cache(), {0, {}}), Error);
  EXPECT_TRUE(fs::exists(cache() / "pass" / "ab" / "abababababababababababababababab"));
}

TEST_F(Upkeep, FindsNothingWhereNothingIs) {
  EXPECT_EQ(trim_store(cache(), {0, {}}).removed, 0U);
  EXPECT_EQ(verify_store(cache()).whole, 0U);
  EXPECT_FALSE(fs::exists(cache()));
}

TEST_F(Upkeep, TrimsByAgeAndBySize) {
  Store store(cache(), 0);
  for (int i = 0; i < 10; ++i) {
    store.put(pass_key(i), std::string(900, 'x'));
    set_used(file(pass_key(i)), std::chrono::hours(10 * i));
  }
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const std::int64_t back = std::chrono::nanoseconds(now - std::chrono::hours(55)).count();
  EXPECT_EQ(trim_store(cache(), {{}, back}).removed, 4U);
  EXPECT_TRUE(store.has(pass_key(5)));
  EXPECT_FALSE(store.has(pass_key(6)));
  const StoreContents left = list_store(cache());
  EXPECT_EQ(trim_store(cache(), {left.bytes / 2, {}}).kept, 3U);
  EXPECT_FALSE(store.has(pass_key(3)));
  EXPECT_EQ(trim_store(cache(), {0, {}}).kept, 0U);
  EXPECT_EQ(look_at_store_folder(cache()), StoreFolder::ours);
}

TEST_F(Upkeep, LeavesAloneWhatIsNotTheStores) {
  Store(cache(), 0).put(pass_key(1), "pixels");
  const fs::path beside = file(pass_key(1)).parent_path() / "notes.txt";
  write_file(beside, "mine");
  write_file(cache() / "README", "mine");
  fs::create_directories(cache() / "Pictures" / "ab");
  EXPECT_EQ(list_store(cache()).others, 3U);
  EXPECT_EQ(trim_store(cache(), {0, {}}).removed, 1U);
  EXPECT_TRUE(fs::exists(beside));
  EXPECT_TRUE(fs::exists(cache() / "README"));
}

TEST_F(Upkeep, RemovesTemporaryFilesOfTheDead) {
  Store(cache(), 0).put(pass_key(1), "pixels");
  // Folders that this process has not swept yet, as another run would find them.
  fs::create_directories(cache() / "survey" / "00");
  const fs::path folder = cache() / "survey" / "00";
  const fs::path dead = folder / (".tmp-" + word_of_the_dead() + "-0123");
  const fs::path living = folder / (".tmp-" + owner_word() + "-0123");
  const fs::path elsewhere = folder / ".tmp-otherhost-boot-12-34-0123",
                 long_ago = folder / ".tmp-otherhost-boot-12-35-0123";
  for (const fs::path& one : {dead, living, elsewhere, long_ago}) write_file(one, "half");
  set_used(long_ago, std::chrono::hours(25));
  trim_store(cache(), {});
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(living));
  EXPECT_TRUE(fs::exists(elsewhere));
  EXPECT_FALSE(fs::exists(long_ago));
}

TEST_F(Upkeep, VerifiesByReading) {
  Store store(cache(), 0);
  for (int i = 0; i < 5; ++i) store.put(pass_key(i), "pixels");
  std::string bytes = read_text(file(pass_key(3)));
  bytes[bytes.size() - 3] ^= 4;
  write_file(file(pass_key(3)), bytes);
  fs::resize_file(file(pass_key(4)), 10);
  Said said;
  const VerifyCounts counts = verify_store(cache());
  const std::string text = said.take();
  EXPECT_EQ(counts.whole, 3U);
  EXPECT_EQ(counts.damaged, 2U);
  EXPECT_TRUE(counts.unreadable.empty());
  EXPECT_EQ(lines_in(text), 2U) << text;
  EXPECT_FALSE(store.has(pass_key(3)));
  EXPECT_FALSE(store.has(pass_key(4)));
  EXPECT_EQ(verify_store(cache()).damaged, 0U);
}

}  // namespace
}  // namespace rnmbake
