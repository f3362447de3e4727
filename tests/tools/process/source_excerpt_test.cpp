#include "tools/process/source_excerpt.hpp"

#include <gtest/gtest.h>

#include "tests/sim/support/temporary_folder.hpp"

namespace articular::source_excerpt_test {

using tools::source_excerpt;

std::string excerpt(const TemporaryFolder& folder, const std::string& rest) {
  return source_excerpt((folder / "scene.toml").string() + rest);
}

TEST(SourceExcerpt, ShowsTheLineAndACaretUnderTheColumn) {
  const TemporaryFolder folder;
  folder.file("scene.toml", "a = 1\n\tbody = \"disc\"\r\n");
  EXPECT_EQ(excerpt(folder, ":2:9: no such body"), "    2 |  body = \"disc\"\n      |         ^\n");
}

TEST(SourceExcerpt, CountsCharactersAndNotBytes) {
  const TemporaryFolder folder;
  folder.file("scene.toml", "µ = \"µm\" # x\n");
  EXPECT_EQ(excerpt(folder, ":1:10: what is wrong"),
            "    1 | µ = \"µm\" # x\n      |          ^\n");
}

TEST(SourceExcerpt, HasNoCaretWithoutAColumn) {
  const TemporaryFolder folder;
  folder.file("scene.toml", "1,2\n3,x\n");
  EXPECT_EQ(excerpt(folder, ":2: expected a number"), "    2 | 3,x\n");
}

TEST(SourceExcerpt, ShowsOfALongLineWhatIsAroundThePlace) {
  const TemporaryFolder folder;
  folder.file("scene.toml", std::string(200, 'a') + "X" + std::string(200, 'b'));
  const std::string shown = excerpt(folder, ":1:201: what is wrong");
  const std::size_t line_end = shown.find('\n');
  EXPECT_LE(line_end, 110u);
  EXPECT_EQ(shown.find('X'), shown.find('^') - line_end - 1) << shown;
  EXPECT_NE(shown.find("aaa"), std::string::npos);
  EXPECT_NE(shown.find("bbb..."), std::string::npos);
}

TEST(SourceExcerpt, PointsBehindTheLineWhereSomethingIsMissing) {
  const TemporaryFolder folder;
  folder.file("scene.toml", "a = [1\n");
  EXPECT_EQ(excerpt(folder, ":1:7: `]` is missing"), "    1 | a = [1\n      |       ^\n");
}

TEST(SourceExcerpt, IsEmptyWhereAMessagePointsAtNoLineOfText) {
  const TemporaryFolder folder;
  folder.file("scene.toml", "a = 1\n\n\x01\n");
  EXPECT_EQ(excerpt(folder, ": cannot be read"), "");
  EXPECT_EQ(excerpt(folder, ":9:1: behind the end"), "");
  EXPECT_EQ(excerpt(folder, ":1:99: behind the end of the line"), "");
  EXPECT_EQ(excerpt(folder, ":2:1: an empty line"), "");
  EXPECT_EQ(excerpt(folder, ":3:1: no text"), "");
  EXPECT_EQ(source_excerpt("--set a=1: what is wrong"), "");
  EXPECT_EQ(source_excerpt(folder.path().string() + ":1:1: a folder"), "");
  EXPECT_EQ(source_excerpt(""), "");
}

}  // namespace articular::source_excerpt_test
