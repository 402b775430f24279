#include "report/write.h"

#include "base/files.h"
#include "report/fixture.h"
#include "report/pack.h"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

Report with_maps(const std::string& key, int size) {
  Report report = report_of({{key, {basis_of("flat", 0.01, 0.02), basis_of("rnm0", 0.01, 0.02)}}});
  std::mt19937 random(1);
  std::uniform_real_distribution<float> light(0.1F, 1);
  for (const char* basis : {"flat", "rnm0"}) {
    FloatImage picture(size, size, 3);
    std::ranges::generate(picture.data(), [&] { return light(random); });
    report.objects.front().maps.push_back({basis, picture, picture, {}, {}});
  }
  return report;
}

TEST(WriteReport, Base64IsTheStandards) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\xfe\x00", 3)), "//4A");
}

TEST(WriteReport, NumbersThatAreNoneBecomeNull) {
  Report report = report_of({{"floor", {basis_of("flat", 0, 0)}}});
  report.objects[0].bases[0].metrics.rmse.high95 = std::numeric_limits<double>::infinity();
  const auto document = nlohmann::json::parse(to_json(report));
  EXPECT_TRUE(document["objects"][0]["bases"][0]["rmse"]["high95"].is_null());
  EXPECT_TRUE(document["objects"][0]["validity"].is_null());
  EXPECT_TRUE(document["objects"][0]["bases"][0]["noise"]["candidate"].is_null());
  EXPECT_EQ(document["scene"][0]["max"]["object"], "floor");
}

TEST(WriteReport, NamesThatAreNoUtf8DoNoHarm) {
  const Report report = with_maps("bad \xff name", 4);
  EXPECT_TRUE(nlohmann::json::accept(to_json(report)));
  EXPECT_NO_THROW(static_cast<void>(to_html(report)));
}

TEST(WriteReport, CsvQuotesWhatNeedsIt) {
  const std::string csv = to_csv(report_of({{"a, \"b\"", {basis_of("flat", 0.5, 0.25)}}}));
  EXPECT_NE(csv.find("\"a, \"\"b\"\"\",flat,100,0,2,1,"), std::string::npos) << csv;
  EXPECT_EQ(count(csv, "\r\n"), 3U);  // header, object, scene
  EXPECT_NE(csv.find("(scene),flat"), std::string::npos);
}

TEST(WriteReport, PageEscapesEveryName) {
  Report report = with_maps("</script><img src=x onerror=alert(1)>", 4);
  report.title = std::string("<b>&\"title\"");
  report.finding = std::string("{{script}} <i>50 %</i>");
  report.settings = {{"<script>", "<!--"}};
  const std::string page = to_html(report);
  EXPECT_EQ(page.find("<img"), std::string::npos);
  EXPECT_EQ(page.find("<i>50"), std::string::npos);
  EXPECT_NE(page.find("&lt;b&gt;&amp;&quot;title&quot;"), std::string::npos);
  EXPECT_NE(page.find("{{script}} &lt;i&gt;"), std::string::npos);  // filled in parts are not filled again
  EXPECT_EQ(count(page, "<script"), count(page, "</script>"));
}

TEST(WriteReport, PageLoadsNothing) {
  const std::string page = to_html(with_maps("floor", 8));
  EXPECT_EQ(page.find("src="), std::string::npos);
  EXPECT_EQ(page.find("@import"), std::string::npos);
  EXPECT_EQ(page.find("url("), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
}

TEST(WriteReport, PageScalesMapsDownUntilItFits) {
  const Report report = with_maps("floor", 256);
  const std::size_t whole = to_html(report).size();
  const HtmlOptions tight{whole * 7 / 10, 256, 960};
  const std::string page = to_html(report, tight);
  EXPECT_LE(page.size(), tight.most_bytes);
  EXPECT_NE(page.find("\"width\":256"), std::string::npos);  // the first basis keeps its size longest
  EXPECT_NE(page.find("\"width\":128"), std::string::npos);
}

TEST(WriteReport, PageEndsUpAsSmallAsItCan) {
  const std::string page = to_html(with_maps("floor", 64), {1000, 256, 960});
  EXPECT_NE(page.find("\"width\":8"), std::string::npos);
}

TEST(WriteReport, WritesThreeFiles) {
  const TempFolder folder;
  write_report(with_maps("floor", 8), folder.path() / "new" / "report");
  for (const char* name : {"report.html", "report.json", "report.csv"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "new" / "report" / name)) << name;
}

TEST(WriteReport, TextIsATable) {
  Report report = report_of({{"floor", {basis_of("flat", -0.01, 0.02)}}});
  report.finding = std::string("All is well.");
  report.reference_only = {"lamp"};
  const std::string text = to_text(report);
  EXPECT_NE(
      text.find("floor    flat   100     -1.00 % (-1.10 to -0.90)  2.00 % (1.90 to 2.10)  10.0 %  20.0 %"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("only in B: lamp\n"), std::string::npos);
  EXPECT_NE(text.find("\nAll is well.\n"), std::string::npos);
}

}  // namespace
}  // namespace rnmbake
