#include "io/drawing/report_page.h"

#include <random>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/archive/sha256.h"
#include "io/tables/csv.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Base64, IsThatOfRfc4648) {
  // Section 10, test vectors.
  const char* vectors[][2] = {{"", ""},
                              {"f", "Zg=="},
                              {"fo", "Zm8="},
                              {"foo", "Zm9v"},
                              {"foob", "Zm9vYg=="},
                              {"fooba", "Zm9vYmE="},
                              {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
  EXPECT_EQ(base64(std::string_view("\xff\xfe\x00", 3)), "//4A");
}

TEST(JsonInHtml, HoldsNothingThatEndsTheElement) {
  const nlohmann::json json = {{"a", "</script><!--<script>"}};
  const std::string safe = json_in_html(json.dump());
  EXPECT_THAT(safe, Not(HasSubstr("<")));
  EXPECT_EQ(nlohmann::json::parse(safe), json);
}

TEST(ReportTemplate, IsCompleteAndLoadsNothing) {
  const std::string text(report_template());
  for (const char* place : {"<!--TITLE-->", "<!--DATA-->"}) {
    EXPECT_EQ(text.find(place), text.rfind(place)) << place;
    EXPECT_THAT(text, HasSubstr(place));
  }
  for (const char* left : {"<!--STYLE-->", "<!--SCRIPT-->", " src=\"", "<link", "@import"})
    EXPECT_THAT(text, Not(HasSubstr(left)));
  EXPECT_THAT(text, HasSubstr("default-src 'none'"));
}

// The digest with which a page's policy allows one script, in base64.
std::string digest_of_script(const std::string& page) {
  const std::string open = "<script>", close = "</script>";
  const size_t from = page.find(open) + open.size();
  const std::string hex = sha256(page.substr(from, page.find(close, from) - from));
  std::string bytes;
  for (size_t i = 0; i < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return base64(bytes);
}

TEST(ReportTemplate, LetsItsOwnScriptRunAndNoOther) {
  for (const std::string_view page : {report_template(), batch_template(), compare_template()}) {
    const std::string text(page);
    EXPECT_EQ(text.find("<script>"), text.rfind("<script>"));
    EXPECT_THAT(text, HasSubstr("script-src 'sha256-" + digest_of_script(text) + "'"));
    EXPECT_THAT(text, Not(HasSubstr("script-src 'unsafe-inline'")));
    // Handlers that a policy of digests would not allow.
    for (const char* handler : {" onclick=\"", " onload=\"", "javascript:"})
      EXPECT_THAT(text, Not(HasSubstr(handler))) << handler;
  }
}

TEST(NormalGait, IsATableOfRangesOverTheCycle) {
  const CsvTable table = csv_from_text(std::string(normal_gait_csv()), "normal_gait.csv");
  ASSERT_EQ(table.rows.size(), 51u);
  for (size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_EQ(table.number(table.rows[i], 0), 2.0 * double(i));
    for (size_t c = 1; c < table.columns.size(); c += 2)
      EXPECT_LT(table.number(table.rows[i], c), table.number(table.rows[i], c + 1));
  }
}

TEST(ChooseEmbedded, TakesVideosAsLongAsThereIsRoom) {
  const TemporaryFolder folder;
  std::vector<ReportClip> clips;
  for (const auto& [name, size] : {std::pair{"a", 60}, {"b", 50}, {"c", 40}})
    clips.push_back({name, folder.write(name, std::string(size_t(size), 'x'))});
  clips.push_back({"gone", folder / "gone"});
  choose_embedded(clips, 100);
  EXPECT_TRUE(clips[0].embedded);
  EXPECT_FALSE(clips[1].embedded);
  EXPECT_TRUE(clips[2].embedded);
  EXPECT_FALSE(clips[3].embedded);
}

TEST(WriteReportPage, HoldsTitleDataAndVideos) {
  const TemporaryFolder folder;
  std::string video(100'001, '\0');  // longer than a block, not a multiple of three
  std::mt19937 random(7);
  for (char& c : video) c = static_cast<char>(random());
  ReportPage page;
  page.title = "<b>\"A\" & 'B'\n";
  page.data_json = R"({"x": "</script>"})";
  page.clips = {{"si\"de", folder.write("video.mp4", video)},
                {"front", folder.write("a b<.mp4", video), false}};
  write_report_page(folder / "report.html", page);
  const std::string text = read_file(folder / "report.html");
  EXPECT_THAT(text, HasSubstr("<title>&lt;b&gt;&quot;A&quot; &amp; &#39;B&#39; </title>"));
  EXPECT_THAT(text, HasSubstr(R"(id="data">{"x": "\u003c/script>"}</script>)"));
  EXPECT_THAT(text, HasSubstr("data-name=\"si&quot;de\">" + base64(video) + "</script>"));
  EXPECT_THAT(text, HasSubstr("data-name=\"front\" data-file=\"a%20b%3C.mp4\"></script>"));
}

TEST(WriteReportPage, LeavesNothingWhenAVideoIsMissing) {
  const TemporaryFolder folder;
  ReportPage page;
  page.clips = {{"side", folder / "none.mp4"}};
  EXPECT_THROW(write_report_page(folder / "report.html", page), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace walktrack
