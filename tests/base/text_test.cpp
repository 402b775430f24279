#include "base/text.h"

#include "base/object_notes.h"
#include "base/text_table.h"

#include <sstream>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(Counted, KnowsTheSingular) {
  EXPECT_EQ(counted(1, "lightmap"), "1 lightmap");
  EXPECT_EQ(counted(0, "lightmap"), "0 lightmaps");
  EXPECT_EQ(counted(2, "mesh"), "2 meshes");
  EXPECT_EQ(counted(2, "launch"), "2 launches");
  EXPECT_EQ(counted(4, "basis"), "4 bases");
  EXPECT_EQ(counted(3, "entry"), "3 entries");
  EXPECT_EQ(counted(3, "ray"), "3 rays");
}

TEST(Printable, ShowsWhatWouldSteerATerminal) {
  EXPECT_EQ(printable("plain ü 柱"), "plain ü 柱");
  EXPECT_EQ(printable("a\033[31mred\a\x7f"), "a\\x1b[31mred\\x07\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\x9b31m")
      << "C1, as UTF-8";
  EXPECT_EQ(printable("\x9b"
                      "31m"),
            "\\x9b31m")
      << "C1, as a byte";
  EXPECT_EQ(printable("\xe2\x80\xae"
                      "exe.gnp"),
            "\\u202eexe.gnp");
  EXPECT_EQ(printable("a\nb"), "a\\x0ab");
  EXPECT_EQ(printable("a\nb", true), "a\nb");
}

TEST(LowerCase, ChangesAsciiLettersAlone) {
  EXPECT_EQ(lower_case("MateriaLS@[`{09"), "materials@[`{09");
  EXPECT_EQ(lower_case("ÄÉ.TGA"), "ÄÉ.tga");
  EXPECT_EQ(lower_extension("Some.DIR/Map.EXR"), ".exr");
  EXPECT_EQ(lower_extension("Some.DIR/MAP"), "");
}

TEST(TextTable, ACellIsOneLine) {
  TextTable table;
  table.add({"a\nb", "1"});
  table.add({"c", "2"});
  std::ostringstream out;
  table.write(out);
  EXPECT_EQ(out.str(), "a\\x0ab  1\nc       2\n");
}

TEST(ObjectNotes, ManyObjectsMakeOneLine) {
  ObjectNotes notes(log::Level::warning);
  for (int i = 0; i < 137; ++i)
    notes.add(fmt::format("o{}", i), "corners without", fmt::format("{} corners", i));
  notes.add("lone", "rest", "1 rest");
  notes.add_line("world: nodes");
  notes.add_line("a line of its own");
  const std::vector<std::string> expected{"o0, o1, o2 and 134 more: corners without", "lone: 1 rest",
                                          "world: nodes", "a line of its own"};
  EXPECT_EQ(notes.lines(), expected);
  EXPECT_EQ(first_names({"a", "b"}), "a and b");
  EXPECT_EQ(first_names({"a", "b", "c"}), "a, b and c");
}

TEST(ObjectNotes, DetailsAreSaidOnRequest) {
  ObjectNotes notes(log::Level::info);
  notes.add("a", "x", "1 x");
  notes.add("b", "x", "2 x");
  log::init(1, log::Format::text);
  testing::internal::CaptureStderr();
  notes.write();
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "rnmbake: a and b: x\nrnmbake: debug: a: 1 x\nrnmbake: debug: b: 2 x\n");
  log::init(0, log::Format::text);
}

}  // namespace
}  // namespace rnmbake
