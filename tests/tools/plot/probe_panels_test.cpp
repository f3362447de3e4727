#include "tools/plot/probe_panels.hpp"

#include <gtest/gtest.h>

#include "sim/base/error.hpp"

namespace articular::tools::probe_panels_test {

using Numbers = std::vector<std::size_t>;

const std::vector<std::string> kNames = {
    "incisor.position.x", "incisor.position.y", "incisor.position.z", "condyle.force.x",
    "condyle.force.y",    "condyle.force.z",    "condyle.area",       "incisor_left.position.x"};

std::string refusal(const std::vector<std::string>& words) {
  try {
    chosen_columns(kNames, words);
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ChosenColumns, AreMeantByNamesFirstPartsAndPatterns) {
  EXPECT_EQ(chosen_columns(kNames, {"condyle.area"}), Numbers{6});
  EXPECT_EQ(chosen_columns(kNames, {"condyle"}), (Numbers{3, 4, 5, 6}));
  EXPECT_EQ(chosen_columns(kNames, {"incisor"}), (Numbers{0, 1, 2}));  // not incisor_left
  EXPECT_EQ(chosen_columns(kNames, {"*.position.x"}), (Numbers{0, 7}));
  EXPECT_EQ(chosen_columns(kNames, {"con*.force"}), (Numbers{3, 4, 5}));
}

TEST(ChosenColumns, ComeInTheOrderOfTheWordsAndOnce) {
  EXPECT_EQ(chosen_columns(kNames, {"condyle.area", "incisor.position.z", "condyle"}),
            (Numbers{6, 2, 3, 4, 5}));
  EXPECT_EQ(chosen_columns(kNames, {}), (Numbers{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(ChosenColumns, AWordThatMeansNoneNamesTheNearest) {
  EXPECT_EQ(refusal({"condyle.forse"}),
            "no run has a probe \"condyle.forse\"; did you mean `condyle.force`?");
  EXPECT_NE(refusal({"zzzzzzzz"}).find("expected one of `incisor`"), std::string::npos);
  EXPECT_EQ(refusal({"out/b"}), "\"out/b\" is neither a folder of a run nor a probe");
  EXPECT_EQ(refusal({"a\x1b\n"}).find('\x1b'), std::string::npos);
}

TEST(ProbePanels, AVectorIsOneAndAScalarIsOne) {
  const std::vector<sim::HistoryColumn> columns = {
      {"a.force.x", "N"}, {"a.force.y", "N"}, {"a.force.z", "N"}, {"a.area", "mm^2"},
      {"b.x", "mm"},      {"b.y", "mm"},      {"b.z", "m"}};
  EXPECT_EQ(probe_panels(columns, {0, 1, 2, 3}, true),
            (std::vector<ProbePanel>{{"a.force", {0, 1, 2}}, {"a.area", {3}}}));
  EXPECT_EQ(probe_panels(columns, {0, 2}, true),
            (std::vector<ProbePanel>{{"a.force.x", {0}}, {"a.force.z", {2}}}));
  EXPECT_EQ(probe_panels(columns, {4, 5, 6}, true).size(), 3U);  // of two units
  EXPECT_EQ(probe_panels(columns, {0, 1, 2}, false).size(), 3U);
}

}  // namespace articular::tools::probe_panels_test
