#include "tools/manual/completed_value.hpp"

#include <gtest/gtest.h>

namespace articular::tools {
namespace {

using Words = std::vector<std::string>;

CompletedValue completed(const std::string& value, const std::string& description = "") {
  return completed_value({{"--option"}, value, description, false, false});
}

TEST(CompletedValue, WordsBetweenBarsAreTheValuesThatThereAre) {
  EXPECT_EQ(completed("sat|gjk").words, (Words{"sat", "gjk"}));
  EXPECT_EQ(completed("front|three-quarter").words, (Words{"front", "three-quarter"}));
  EXPECT_TRUE(completed("LENGTH").empty());
  EXPECT_TRUE(completed("W|WxH").empty());
}

TEST(CompletedValue, FilesHaveTheEndingsThatTheDescriptionNames) {
  EXPECT_EQ(completed("TEXT", "Scenario file (.toml)").endings, (Words{".toml"}));
  EXPECT_EQ(completed("SURFACE", ".obj, .stl or .vtk with triangles").endings,
            (Words{".obj", ".stl", ".vtk"}));
  EXPECT_TRUE(completed("PROBE", "A column of history.csv").empty());
}

TEST(CompletedValue, AFileWithoutEndingMayBeAny) {
  EXPECT_TRUE(completed("FILE", "A table").files);
  EXPECT_FALSE(completed("FILE", "A table (.csv)").files);
}

TEST(CompletedValue, AFolderMayBeOneOfSeveralThings) {
  EXPECT_TRUE(completed("DIR").folders);
  EXPECT_TRUE(completed("DIR... [PROBE...]").folders);
  EXPECT_TRUE(completed("DIR|SCENARIO", "A scenario (.toml)").folders);
  EXPECT_FALSE(completed("DIRECTION").folders);
}

TEST(CompletedValue, ShippedScenariosServeForAFileButNotStudies) {
  const std::string description =
      "File (.toml), or the name of a shipped one: see `articular scenarios`";
  const auto listed = [&](const std::string& name) {
    return completed_value({{name}, "TEXT", description, true, false}).listing;
  };
  EXPECT_NE(listed("scenario").find("study /!s"), std::string::npos);
  EXPECT_NE(listed("study").find("study /s"), std::string::npos);
  EXPECT_EQ(completed("TEXT", "Scenario file (.toml)").listing, "");
}

TEST(CompletedValue, AFlagHasNone) { EXPECT_TRUE(completed("", "Writes a table (.csv)").empty()); }

}  // namespace
}  // namespace articular::tools
