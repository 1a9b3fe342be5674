#include "io/config/text.h"

#include <gtest/gtest.h>

namespace walktrack {
namespace {

TEST(CsvCell, QuotesOnlyWhatNeedsIt) {
  EXPECT_EQ(csv_cell("plain text"), "plain text");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("say \"hi\""), "\"say \"\"hi\"\"\"");
  EXPECT_EQ(csv_cell("two\nlines"), "\"two\nlines\"");
}

TEST(HtmlText, LeavesNoMarkup) {
  EXPECT_EQ(html_text("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
  EXPECT_EQ(html_text("Größe"), "Größe");
}

TEST(UrlPath, EncodesWhatIsNoPathCharacter) {
  EXPECT_EQ(url_path("a b/c%d?.mp4"), "a%20b/c%25d%3F.mp4");
  EXPECT_EQ(url_path("ä"), "%C3%A4");
}

TEST(OneLine, ReplacesControlCharacters) { EXPECT_EQ(one_line("a\nb\t\x7f"), "a b  "); }

}  // namespace
}  // namespace walktrack
