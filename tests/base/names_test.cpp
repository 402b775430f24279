#include "base/names.h"

#include "base/utf8.h"

#include <ostream>
#include <set>
#include <string>
#include <utility>

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
  for (const std::string name :
       {"Cube",  "cube", "CUBE", "Cube",     "Cube",     "Ärger", "ärger", "A\u0308rger", "Ωmega",
        "ωmega", "Дом",  "дом",  "ὈΔΥΣΣΕΎΣ", "ὀδυσσεύς", "a/b",   "a\\b",  "a_b",         "a:b",
        "",      "",     "con",  "CON",      "nul.txt",  "a\xff", "a\xfe", "a\xc0\xaf",   "a\xe0\x80\xaf",
        "a__"}) {
    const std::string stem = stems.take(name);
    EXPECT_TRUE(seen.insert(fold_case(stem)).second) << name << " became " << stem;
    EXPECT_NE(stem, "con");
  }
}

struct NamePair {
  const char* what;
  std::string first, second;
  bool same_file;  // for some file system
};

void PrintTo(const NamePair& pair, std::ostream* out) {
  *out << pair.what;
}

class SecondName : public testing::TestWithParam<NamePair> {};

TEST_P(SecondName, IsKeptUnlessSomeFileSystemTakesItForTheFirst) {
  const auto& [what, first, second, same_file] = GetParam();
  for (const auto& [one, other] : {std::pair(first, second), std::pair(second, first)}) {
    FileStems stems;
    EXPECT_EQ(stems.take(one), one);
    const std::string stem = stems.take(other);
    if (same_file) {
      EXPECT_TRUE(stem.starts_with(other + "-") && stem.size() > other.size() + 1) << stem;
    } else {
      EXPECT_EQ(stem, other);
    }
    EXPECT_EQ(FileStems({one}).take(other), stem);  // as if the first's files were there already
  }
}

INSTANTIATE_TEST_SUITE_P(
    Pairs, SecondName,
    testing::Values(NamePair{"e_acute_composed_or_not", "caf\u00e9", "cafe\u0301", true},
                    NamePair{"case_and_form_at_once", "CAF\u00c9", "cafe\u0301", true},
                    NamePair{"an_accent_is_no_trifle", "caf\u00e9", "cafe", false},
                    NamePair{"two_marks_in_either_order", "q\u0307\u0323", "q\u0323\u0307", true},
                    NamePair{"hangul_composed_or_not", "\ud55c", "\u1112\u1161\u11ab", true},
                    NamePair{"angstrom_sign", "\u212b", "\u00e5", true},
                    NamePair{"sharp_s", "stra\u00dfe", "STRASSE", true},
                    NamePair{"capital_sharp_s", "stra\u00dfe", "STRA\u1e9eE", true},
                    NamePair{"sharp_s_is_two_letters", "stra\u00dfe", "strase", false},
                    NamePair{"capital_i_with_dot", "\u0130", "i\u0307", true},
                    NamePair{"capital_i_with_dot_is_no_i", "\u0130", "i", false},
                    NamePair{"final_sigma", "\u03a3\u0391\u03a3", "\u03c3\u03b1\u03c2", true},
                    NamePair{"armenian", "\u0531", "\u0561", true},
                    NamePair{"deseret", "\U00010400", "\U00010428", true},
                    NamePair{"ligature", "\ufb01n", "FIN", true},
                    NamePair{"soft_hyphen", "ta\u00adble", "table", true},
                    NamePair{"zero_width_joiner", "ta\u200dble", "table", true},
                    NamePair{"full_width_is_another_letter", "\uff21", "A", false}),
    [](const auto& tested) { return std::string(tested.param.what); });

TEST(FoldCase, IsLowerCaseInAscii) {
  std::string all, lower;
  for (char c = 0; c >= 0 && c < 127; ++c) {
    all += c;
    lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  EXPECT_EQ(fold_case(all), lower);
}

TEST(FoldCase, KeepsWhatIsNoUtf8AndFoldsAroundIt) {
  EXPECT_EQ(fold_case(""), "");
  EXPECT_EQ(fold_case("A\xff\x80"
                      "B\xc3"),
            "a\xff\x80"
            "b\xc3");
  EXPECT_EQ(fold_case("\xc0\xaf\xed\xa0\x80"), "\xc0\xaf\xed\xa0\x80");  // overlong, half a surrogate pair
  EXPECT_EQ(fold_case("E\u0301\xff"
                      "E\u0301"),
            "\u00e9\xff\u00e9");
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
  EXPECT_EQ(nearest_name("\xff\xff", keys), std::nullopt);
  EXPECT_EQ(nearest_name("Bu\u0308hne", {"b\u00fchne", "buehne"}), "b\u00fchne");
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
