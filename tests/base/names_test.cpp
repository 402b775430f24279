#include "base/names.h"

#include "base/utf8.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(FileStems, KeepsHarmlessNames) {
  FileStems stems;
  for (const char* name : {"Cube", "Cube.001", "foo_.001", "floor tile (3)", "Säule-Ø2", "柱", "a"}) {
    EXPECT_EQ(stems.take(name), name);
  }
}

TEST(FileStems, NeverLeavesTheFolder) {
  FileStems stems;
  for (const std::string name :
       {"../../x", "a/b", "/etc/passwd", "..", ".", "a\\b", "C:x", "....//", "-rf", ".hidden"}) {
    const std::string stem = stems.take(name);
    EXPECT_EQ(stem.find_first_of("/\\:"), std::string::npos) << stem;
    EXPECT_EQ(stem.find(".."), std::string::npos) << stem;
    EXPECT_NE(stem.front(), '.') << stem;
    EXPECT_NE(stem.front(), '-') << stem;
    EXPECT_NE(stem, name);
  }
}

TEST(FileStems, DropsControlCharactersAndBrokenUtf8) {
  FileStems stems;
  for (const std::string& name :
       {std::string("a\nb"), std::string("a\0b", 3), std::string("\x1b[31m"), std::string("a\xff"),
        std::string("a\xc3"), std::string("a\u202eb"), std::string("\x7f")}) {
    const std::string stem = stems.take(name);
    for (std::size_t i = 0; i < stem.size();) {
      const CodePoint c = decode_utf8(stem, i);
      EXPECT_TRUE(c.valid);
      EXPECT_GE(c.value, 0x20u);
      EXPECT_NE(c.value, 0x7Fu);
      EXPECT_NE(c.value, 0x202Eu);
      i += c.bytes;
    }
    EXPECT_FALSE(stem.empty());
  }
}

TEST(FileStems, CutsLongNamesBetweenCharacters) {
  FileStems stems;
  const std::string ascii(300, 'x');
  std::string wide;
  for (int i = 0; i < 100; ++i) wide += "柱";
  for (const std::string& name : {ascii, wide, ascii + "y"}) {
    const std::string stem = stems.take(name);
    EXPECT_LE(stem.size(), FileStems::max_bytes);
    EXPECT_GT(stem.size(), FileStems::max_bytes - 4);
    for (std::size_t i = 0; i < stem.size();) {
      const CodePoint c = decode_utf8(stem, i);
      ASSERT_TRUE(c.valid);
      i += c.bytes;
    }
  }
}

TEST(FileStems, NoTwoAreTheSameFileAnywhere) {
  FileStems stems;
  std::set<std::string> seen;
  for (const char* name :
       {"Cube", "cube", "CUBE", "Cube", "Cube", "Ärger", "ärger", "Ωmega", "ωmega", "Дом",
        "дом",  "a/b",  "a\\b", "a_b",  "a:b",  "",      "",      "con",   "CON",   "nul.txt"}) {
    std::string key;
    const std::string stem = stems.take(name);
    for (std::size_t i = 0; i < stem.size();) {
      const CodePoint c = decode_utf8(stem, i);
      key += std::to_string(static_cast<unsigned>(fold_case(c.value))) + ' ';
      i += c.bytes;
    }
    EXPECT_TRUE(seen.insert(key).second) << name << " became " << stem;
    EXPECT_NE(stem, "con");
  }
}

TEST(FileStems, SameNameGivesSameStemInEveryRun) {
  FileStems one, other;
  EXPECT_EQ(one.take("a/b"), other.take("a/b"));
  EXPECT_EQ(one.take("a/b").substr(0, 4), "a_b-");
}

TEST(NearestName, ForgivesSlipsOnly) {
  const std::vector<std::string> keys = {"samples", "bounces", "texels_per_unit", "seed"};
  EXPECT_EQ(nearest_name("sample", keys), "samples");
  EXPECT_EQ(nearest_name("smaples", keys), "samples");
  EXPECT_EQ(nearest_name("Seed", keys), "seed");
  EXPECT_EQ(nearest_name("texel_per_unit", keys), "texels_per_unit");
  EXPECT_EQ(nearest_name("colour", keys), std::nullopt);
  EXPECT_EQ(nearest_name("", keys), std::nullopt);
  EXPECT_EQ(did_you_mean("bounce", keys), ", did you mean 'bounces'?");
  EXPECT_EQ(did_you_mean("zzzzzz", keys), "");
}

struct GlobCase {
  const char* pattern;
  const char* text;
  bool matches;
};

class Glob : public testing::TestWithParam<GlobCase> {};

TEST_P(Glob, Matches) {
  EXPECT_EQ(glob_match(GetParam().pattern, GetParam().text), GetParam().matches)
      << GetParam().pattern << " against " << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(
    Cases, Glob,
    testing::Values(GlobCase{"floor*", "floor", true}, GlobCase{"floor*", "floor.001", true},
                    GlobCase{"floor*", "Floor", false}, GlobCase{"*", "", true}, GlobCase{"", "", true},
                    GlobCase{"", "a", false}, GlobCase{"?", "", false}, GlobCase{"?", "柱", true},
                    GlobCase{"??", "柱", false}, GlobCase{"a*b*c", "a__b__b__c", true},
                    GlobCase{"a*b*c", "a__c__b", false}, GlobCase{"*.00[1-3]", "Cube.002", true},
                    GlobCase{"*.00[1-3]", "Cube.004", false}, GlobCase{"[!a]b", "cb", true},
                    GlobCase{"[!a]b", "ab", false}, GlobCase{"[^a]b", "cb", true}, GlobCase{"[]]", "]", true},
                    GlobCase{"[]a]", "a", true}, GlobCase{"[ab", "[ab", true}, GlobCase{"[a-]", "-", true},
                    GlobCase{"[ä-ö]", "ö", true}, GlobCase{"*/x", "a/b/x", true}, GlobCase{"a**", "a", true},
                    GlobCase{"[a]*[b]", "axxb", true}, GlobCase{"a", "ab", false}));

TEST(GlobMatch, NoPatternTakesForever) {
  const std::string text(2000, 'a');
  std::string pattern;
  for (int i = 0; i < 200; ++i) pattern += "a*";
  EXPECT_FALSE(glob_match(pattern + "b", text));
}

TEST(Utf8, RejectsWhatIsNotUtf8) {
  for (const std::string text :
       {"\x80", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe6\x9f", "\xff"}) {
    EXPECT_FALSE(decode_utf8(text, 0).valid);
  }
  EXPECT_EQ(decode_utf8("\U0001F600", 0).value, 0x1F600u);
}

}  // namespace
}  // namespace rnmbake
