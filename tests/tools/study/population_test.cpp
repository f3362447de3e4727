// Populations: what is drawn, what is said of it, and `articular study` as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/base/error.hpp"
#include "tests/tools/support/program.hpp"
#include "tools/study/population_result.hpp"
#include "tools/study/population_text.hpp"

namespace articular::population_test {

using namespace articular::tools;

/// A run that takes no time: y is twice x.
const std::string kTwice =
    "title = 'Twice'\n"
    "command = ['sh', '-c', \"printf 'time [s],y [mm]\\\\n0,%s\\\\n' {x * 2} > history.csv\"]\n"
    "[[output]]\nname = 'double'\ncolumn = 'y [mm]'\n";
const std::string kUniform =
    "[[parameter]]\nname = 'x'\ndistribution = 'uniform'\nlowest = 0\nhighest = 1\n";
const std::string kTwenty = "[population]\nsamples = 20\n";

/// Ishigami's function in awk: {name} are the parameters.
const std::string kIshigami = R"(
title = "Ishigami"
command = ["awk", 'BEGIN { a = {x1}; b = {x2}; c = {x3}; s = sin(a); print "time [s],f [-]" > "history.csv"; print "0," s + 7 * sin(b) * sin(b) + 0.1 * c * c * c * c * s > "history.csv" }']
[[output]]
name = "f"
column = "f [-]"
[[parameter]]
name = "x1"
distribution = "uniform"
lowest = -3.14159265358979
highest = 3.14159265358979
[[parameter]]
name = "x2"
distribution = "uniform"
lowest = -3.14159265358979
highest = 3.14159265358979
[[parameter]]
name = "x3"
distribution = "uniform"
lowest = -3.14159265358979
highest = 3.14159265358979
[population]
index_rows = 128
)";

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

std::vector<std::vector<std::string>> table_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

class PopulationFile : public ::testing::Test {
 protected:
  Study read(const std::string& text) const {
    folder_.file("s.toml", text);
    return read_study(folder_ / "s.toml");
  }
  std::string error(const std::string& text) const {
    try {
      read(text);
    } catch (const sim::InputError& failure) {
      const std::string message = failure.what();
      return message.substr(message.rfind("s.toml:"));
    }
    return "no error";
  }
  TemporaryFolder folder_;
};

TEST_F(PopulationFile, CasesAreDrawnThenTornadoThenRows) {
  const Study study =
      read(kTwice + kUniform + "[population]\nsamples = 3\ntornado = true\nindex_rows = 2\n");
  const PopulationCases population = population_cases(study);
  std::vector<std::string> names;
  for (const StudyCase& c : population.cases) names.push_back(c.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"sample 001", "sample 002", "sample 003", "all medians",
                                      "x low", "x high", "row 001 A", "row 001 B", "row 001 x",
                                      "row 002 A", "row 002 B", "row 002 x"}));
  EXPECT_EQ(population.num_samples, 3u);
  EXPECT_EQ(population.num_tornado, 3u);
  EXPECT_DOUBLE_EQ(population.values(0, 3), 0.5);
  EXPECT_DOUBLE_EQ(population.values(0, 4), 0.05);
  EXPECT_EQ(population.values(0, 8), population.values(0, 7));  // of one parameter AB is B
  EXPECT_NE(population.cases[3].command[2].find("%s\\n' 1 >"), std::string::npos)
      << population.cases[3].command[2];
}

TEST_F(PopulationFile, ParametersArePathsWithUnitsOrStandInBraces) {
  folder_.file("scene.toml", "");
  const Study study = read(
      "scenario = 'scene.toml'\nset = { 'body.a.density' = '{d * 2} kg/m^3' }\n"
      "prepare = ['anatomy', 'knee', '--scale', '{d}', '--out', '${ARTICULAR_PREPARED}']\n"
      "[population]\ntornado = true\n"
      "[[parameter]]\nname = 'd'\ndistribution = 'normal'\nmean = 1\nsd = 0.1\n"
      "[[parameter]]\nname = 'E'\npath = 'body.a.E'\ndistribution = 'uniform'\nlowest = '1 MPa'\n"
      "highest = '3000 kPa'\n[[output]]\ncolumn = 'y [mm]'\n");
  const PopulationCases population = population_cases(study);
  EXPECT_EQ(population.cases[0].settings.overrides,
            (std::vector<std::string>{"body.a.density=\"2 kg/m^3\"", "body.a.E=\"2 MPa\""}));
  EXPECT_EQ(population.cases[0].settings.prepare[3], "1");
  EXPECT_EQ(population.cases[0].settings.prepare[5], "${ARTICULAR_PREPARED}");
}

TEST_F(PopulationFile, AnatomiesTakeTheirTurns) {
  for (const char* name : {"b", "a"}) std::filesystem::create_directories(folder_ / "all" / name);
  folder_.file("all/readme.txt", "");
  const std::string head =
      "scenario = 's'\n[[output]]\ncolumn = 'y [mm]'\n[population]\nanatomies = 'all'\n";
  const PopulationCases alone = population_cases(read(head));
  ASSERT_EQ(alone.cases.size(), 2u);
  EXPECT_EQ(alone.cases[0].name, "anatomy a");
  EXPECT_EQ(alone.cases[0].environment,
            std::vector<std::string>{"ARTICULAR_ANATOMY=" + (folder_ / "all/a").string()});
  const PopulationCases drawn = population_cases(
      read(head + "samples = 3\n[[parameter]]\nname = 'x'\npath = 'p'\ndistribution = 'uniform'\n"
                  "lowest = 0\nhighest = 1\n"));
  ASSERT_EQ(drawn.cases.size(), 3u);
  EXPECT_EQ(drawn.cases[1].name, "sample 002, b");
  EXPECT_EQ(drawn.cases[2].name, "sample 003, a");
}

TEST_F(PopulationFile, MistakesAreSaidWithTheirPlaces) {
  EXPECT_NE(error(kTwice + kTwenty).find("nothing varies; expected [[parameter]] tables"),
            std::string::npos);
  EXPECT_NE(error(kTwice + kTwenty + kUniform + "mean = 3\n").find("uniform distribution has"),
            std::string::npos);
  EXPECT_NE(error(kTwice + kTwenty + kUniform + kUniform).find("a second parameter"),
            std::string::npos);
  EXPECT_NE(error(kTwice + kTwenty + kUniform + "path = 'p'\n" +
                  "[[parameter]]\nname = 'z'\ndistribution = 'uniform'\nlowest = 0\nhighest = 1\n"
                  "path = 'p'\n")
                .find("`x` changes `p` too"),
            std::string::npos);
  EXPECT_NE(error(kTwice + kTwenty +
                  "[[parameter]]\nname = 'y'\ndistribution = 'uniform'\nlowest = 0\nhighest = 1\n")
                .find("no [[parameter]] `x`"),
            std::string::npos);
  EXPECT_NE(error(kTwice + kTwenty + kUniform +
                  "[[parameter]]\nname = 'y'\ndistribution = 'uniform'\nlowest = 0\nhighest = 1\n")
                .find("parameter `y` changes nothing"),
            std::string::npos);
  EXPECT_NE(error("scenario = 's'\nset = { E = '{x} MPa' }\n[[output]]\ncolumn = 'y'\n" + kTwenty +
                  "[[parameter]]\nname = 'x'\ndistribution = 'uniform'\nlowest = '1 kPa'\n"
                  "highest = '2 kPa'\n")
                .find("expected `{x} kPa`"),
            std::string::npos);
  EXPECT_NE(error(kTwice + kTwenty +
                  "[[parameter]]\nname = 'x'\ndistribution = 'normal'\nmean = '1 mm'\nsd = 2\n")
                .find("expected a value in `mm`, as `mean`"),
            std::string::npos);
  EXPECT_NE(error(kTwice + kTwenty +
                  "[[parameter]]\nname = 'x'\ndistribution = 'normal'\n"
                  "mean = 1\nsd = 1\nlowest = 50\n")
                .find("nearly nothing of the distribution"),
            std::string::npos);
  EXPECT_NE(error(kTwice + kUniform + "[population]\nindex_rows = 4\n" +
                  "[[correlation]]\nof = ['x', 'z']\nvalue = 0.5\n")
                .find("no [[parameter]] `z`"),
            std::string::npos);
  EXPECT_NE(error(kTwice + kUniform + kTwenty + "[[knob]]\nname = 'k'\npath = 'p'\nvalues = [1]\n")
                .find("a [population] is"),
            std::string::npos);
  EXPECT_NE(error(kTwice + kUniform).find("they go with [population]"), std::string::npos);
  EXPECT_NE(error("scenario = 's'\n[[output]]\ncolumn = 'y'\n[population]\nanatomies = 'none'\n")
                .find("none can't be read"),
            std::string::npos);
}

TEST_F(PopulationFile, SobolIndicesNeedIndependentParameters) {
  const std::string two =
      "command = ['true', '{x}', '{y}']\n[[output]]\ncolumn = 'y [mm]'\n" + kUniform +
      "[[parameter]]\nname = 'y'\ndistribution = 'uniform'\nlowest = 0\nhighest = 1\n"
      "[[correlation]]\nof = ['x', 'y']\nvalue = 0.5\n";
  EXPECT_NE(error(two + "[population]\nindex_rows = 4\n").find("independent parameters"),
            std::string::npos);
  EXPECT_EQ(error(two + "[population]\nsamples = 4\n"), "no error");
}

// A failure makes a row incomplete and a bar unknown, and is no value of the distribution.
TEST_F(PopulationFile, FailuresLeaveWhatTheyDoNotTouch) {
  const Study study =
      read(kTwice + kUniform + "[population]\nsamples = 4\ntornado = true\nindex_rows = 8\n");
  const PopulationCases population = population_cases(study);
  std::vector<CaseRecord> records(population.cases.size());
  std::vector<std::vector<OutputValue>> values(population.cases.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    const bool fails = i == 1 || i == 5 || i == 7;  // sample 002, x low, row 001 A
    records[i].runs.push_back({ProgramUse::End::Exited, fails ? 3 : 0, 1, 1, 1});
    if (!fails) values[i] = {{{0}, {2 * population.values(0, static_cast<Eigen::Index>(i))}}};
  }
  const PopulationResult result = population_result(study, population, records, values);
  EXPECT_EQ(result.succeeded, records.size() - 3);
  const PopulationOutput& output = result.outputs[0];
  EXPECT_EQ(output.drawn.size(), 3u);
  EXPECT_EQ(output.at_medians, 1);
  EXPECT_TRUE(std::isnan(output.bars[0].low));
  EXPECT_DOUBLE_EQ(output.bars[0].high, 1.9);
  EXPECT_EQ(output.whole_rows, 7);
  EXPECT_NEAR(output.ranks[0], 1, 1e-12);
  const PopulationStudy all{study, population, records, result};
  const std::string text = population_text(all);
  EXPECT_NE(text.find("| sample 002 | could not go on |"), std::string::npos) << text;
  EXPECT_NE(text.find("7 rows of 8"), std::string::npos) << text;
}

TEST(Population, WritesItsTextItsTableAndItsPage) {
  const TemporaryFolder folder;
  folder.file("s.toml", kTwice + kUniform + "[population]\nsamples = 20\ntornado = true\n");
  const ProgramResult result = run_program(folder, "study s.toml --jobs 2");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string text = content(folder / "out/s/population.md");
  EXPECT_NE(text.find("23 of 23 cases succeeded (100 %)"), std::string::npos) << text;
  EXPECT_NE(text.find("| double [mm] | 20 | "), std::string::npos) << text;
  EXPECT_NE(text.find("| x | 0.05 | 0.1 | 0.95 | 1.9 |"), std::string::npos) << text;
  const auto table = table_of(content(folder / "out/s/population.csv"));
  ASSERT_EQ(table.size(), 24u);
  for (std::size_t i = 1; i < table.size(); ++i)
    EXPECT_NEAR(std::stod(table[i][7]), 2 * std::stod(table[i][6]), 1e-5);
  const std::string page = content(folder / "out/s/population.html");
  EXPECT_NE(page.find("\"kind\":\"population\""), std::string::npos);
  EXPECT_EQ(page.find("<script src="), std::string::npos);
}

TEST(Population, IndicesOfIshigamisFunctionAreThoseOfItsClosedForm) {
  const TemporaryFolder folder;
  folder.file("s.toml", kIshigami);
  const ProgramResult result = run_program(folder, "study s.toml --jobs 2 --quiet");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string page = content(folder / "out/s/population.html");
  const std::string mark = "<script id=\"data\" type=\"application/json\">";
  const std::size_t begin = page.find(mark) + mark.size();
  const auto data =
      nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  const auto& indices = data.at("outputs")[0].at("indices");
  const double first[] = {0.3139, 0.4424, 0}, total[] = {0.5576, 0.4424, 0.2437};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(indices[i].at("first")[0], first[i], 0.15) << i;  // of 128 rows
    EXPECT_NEAR(indices[i].at("total")[0], total[i], 0.15) << i;
  }
}

TEST(Population, WhatAProgramSaidLastIsWhyItFailed) {
  const TemporaryFolder folder;
  const std::string rest = "[[output]]\ncolumn = 'y [mm]'\n[population]\nsamples = 2\n" + kUniform;
  folder.file("a.toml", "command = ['sh', '-c', 'echo too thin: {x}; exit 3']\n" + rest);
  EXPECT_EQ(run_program(folder, "study a.toml").exit_code, 3);
  const std::string text = content(folder / "out/a/population.md");
  EXPECT_NE(text.find("0 of 2 cases succeeded"), std::string::npos) << text;
  EXPECT_NE(text.find("| could not go on | too thin: 0."), std::string::npos) << text;
  folder.file("b.toml", "command = ['no-such-program', '{x}']\n" + rest);
  EXPECT_EQ(run_program(folder, "study b.toml").exit_code, 3);
  EXPECT_NE(content(folder / "out/b/population.md").find("| can't start no-such-program |"),
            std::string::npos);
}

// Nothing is run twice, and more samples of a random design begin with the same ones.
TEST(Population, RunsAgainOnlyWhatIsMissing) {
  const TemporaryFolder folder;
  const std::string random = "design = 'random'\n";
  folder.file("s.toml", kTwice + kUniform + kTwenty + random);
  ASSERT_EQ(run_program(folder, "study s.toml").exit_code, 0);
  EXPECT_EQ(run_program(folder, "study s.toml --jobs 3").err, "");
  folder.file("s.toml", kTwice + kUniform + "[population]\nsamples = 25\n" + random);
  EXPECT_EQ(count(run_program(folder, "study s.toml").err, "\n"), 5u);
}

TEST(Population, InterruptedItGoesOnWithWhatIsMissing) {
  const TemporaryFolder folder;
  folder.file("s.toml",
              "command = ['sh', '-c', \"sleep {x}; printf 'time [s],y [mm]\\\\n0,1\\\\n' > "
              "history.csv\"]\n[[output]]\ncolumn = 'y [mm]'\n[population]\nsamples = 8\n"
              "[[parameter]]\nname = 'x'\ndistribution = 'uniform'\nlowest = 0.1\nhighest = 0.4\n");
  const ProgramResult stopped =
      run_shell(folder,
                "\"$articular\" study s.toml & pid=$!; "
                "while [ ! -f out/s/cases/sample_002/case.json ] && kill -0 $pid; do sleep 0.02; "
                "done; kill -TERM $pid; wait $pid");
  EXPECT_EQ(stopped.exit_code, 130);
  const ProgramResult rest = run_program(folder, "study s.toml");
  EXPECT_EQ(rest.exit_code, 0);
  EXPECT_LE(count(rest.err, "\n"), 6u);
  EXPECT_GE(count(rest.err, "\n"), 4u);
}

}  // namespace articular::population_test
