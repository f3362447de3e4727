// `articular study` as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tools/support/program.hpp"

namespace articular::study_test {

// A bar that hangs under its own weight, in equilibrium: goes down by rho g L^2 / 2 E = 2.4525 mm.
const std::string kHead =
    "scenario = '" ARTICULAR_SOURCE_DIR
    "/scenarios/verification/hanging_beam.toml'\n"
    "set = { analysis = 'static', duration = '1 s', 'integrator.step' = '1 s', "
    "'output.interval' = '1 s' }\n";
const std::string kCells =
    "[[knob]]\nname = 'cells'\npath = 'body.beam.geometry.box.cells'\n"
    "values = [[1, 1, 5], [2, 2, 10]]\n";
const std::string kEnd = "[[output]]\nname = 'end'\ncolumn = 'end.position.z [mm]'\n";
const std::string kExact = "exact = -102.4525\nscale = 2.4525\n";

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

TEST(Study, WritesItsTableItsTextAndItsPicture) {
  const TemporaryFolder folder;
  folder.file("s.toml", kHead + "title = 'Bars'\nrepeats = 2\n" + kCells + kEnd + kExact);
  const ProgramResult result = run_program(folder, "study s.toml");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "out/s/study.md\nout/s/study.csv\nout/s/pareto.svg\n");
  EXPECT_NE(result.err.find("[6/6] cells = [2, 2, 10]: done"), std::string::npos) << result.err;
  const std::string table = content(folder / "out/s/study.csv");
  EXPECT_EQ(count(table, "\n"), 4u);
  EXPECT_EQ(count(table, ",done,"), 3u);
  EXPECT_NE(content(folder / "out/s/study.md").find("| On the front |"), std::string::npos);
  EXPECT_NE(content(folder / "out/s/pareto.svg").find("Bars"), std::string::npos);
}

// Nothing says what is right.
TEST(Study, WithoutReferenceItListsWhatCameOut) {
  const TemporaryFolder folder;
  folder.file("s.toml", kHead + kCells +
                            "[[case]]\nname = 'broken'\nset = { "
                            "'integrator.max_iterations' = 1, 'load.0.acceleration' = "
                            "'0 0 -9e5 m/s^2', 'body.beam.material.law' = "
                            "'neo-hookean' }\n" +
                            kEnd);
  const ProgramResult result = run_program(folder, "study s.toml");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "out/s/study.md\nout/s/study.csv\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "out/s/pareto.gnuplot"));
  const std::string text = content(folder / "out/s/study.md");
  EXPECT_NE(text.find("| Case | end [mm] | wall time [s] |"), std::string::npos) << text;
  EXPECT_NE(text.find("| cells = [2, 2, 10] | -102.4"), std::string::npos) << text;
  EXPECT_NE(text.find("| broken | could not go on |"), std::string::npos) << text;
  const std::string table = content(folder / "out/s/study.csv");
  EXPECT_NE(table.find("memory [MB],end = end.position.z [mm]\n"), std::string::npos) << table;
  EXPECT_EQ(count(table, "\n"), 5u);
}

// The file is as it was: nothing runs. One number in it is another: that case alone runs.
TEST(Study, RunsAgainOnlyWhatIsMissing) {
  const TemporaryFolder folder;
  folder.file("s.toml", kHead + kCells + kEnd + kExact);
  ASSERT_EQ(run_program(folder, "study s.toml").exit_code, 0);
  const ProgramResult again = run_program(folder, "study s.toml");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_EQ(again.err, "");
  folder.file("s.toml", kHead + kCells +
                            "[[case]]\nname = 'stiff'\nset = { "
                            "'body.beam.material.young_modulus' = '40 kPa' }\n" +
                            kEnd + kExact);
  const ProgramResult more = run_program(folder, "study s.toml");
  EXPECT_EQ(more.exit_code, 0);
  EXPECT_EQ(count(more.err, "\n"), 1u) << more.err;
  EXPECT_NE(more.err.find("[1/1] stiff: done"), std::string::npos) << more.err;
  EXPECT_EQ(count(run_program(folder, "study s.toml --fresh").err, "\n"), 4u);
}

/// A block of six tetrahedra, 10 mm wide.
std::string block(const std::string& height) {
  return "# vtk DataFile Version 3.0\nblock\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n"
         "0 0 0 10 0 0 10 10 0 0 10 0 0 0 " +
         height + " 10 0 " + height + " 10 10 " + height + " 0 10 " + height +
         "\nCELLS 6 30\n4 0 1 2 6\n4 0 2 3 6\n4 0 3 7 6\n4 0 7 4 6\n4 0 4 5 6\n4 0 5 1 6\n"
         "CELL_TYPES 6\n10 10 10 10 10 10\n";
}

// The scenario's text and the command are as they were, and results would be those of the old file.
TEST(Study, RunsAgainWhatReadAFileThatHasChanged) {
  const TemporaryFolder folder;
  folder.file("block.toml",
              "duration = '1 s'\nanalysis = 'static'\n[integrator]\nstep = '1 s'\n"
              "[[body]]\nname = 'floor'\nkind = 'fixed'\n"
              "[[body]]\nname = 'block'\nkind = 'tissue'\ndensity = '1 g/cm^3'\n"
              "mesh = { file = 'block.vtk' }\n"
              "material = { law = 'neo-hookean', young_modulus = '15 kPa', poisson_ratio = 0.3 }\n"
              "[[attach]]\nbody = 'block'\nto = 'floor'\n"
              "region = { box = ['-1 -1 -1 mm', '11 11 1 mm'] }\n"
              "[[probe]]\nname = 'top'\nkind = 'point'\nbody = 'block'\npoint = '0 0 10 mm'\n");
  folder.file("s.toml",
              "scenario = 'block.toml'\n"
              "[[knob]]\nname = 'stiffness'\npath = 'body.block.material.young_modulus'\n"
              "values = ['20 kPa']\n[[output]]\nname = 'top'\ncolumn = 'top.position.z [mm]'\n");
  folder.file("block.vtk", block("10"));
  ASSERT_EQ(run_program(folder, "study s.toml").exit_code, 0);
  EXPECT_EQ(run_program(folder, "study s.toml").err, "");
  folder.file("block.vtk", block("12"));
  const ProgramResult again = run_program(folder, "study s.toml");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(count(again.err, ": done"), 2u) << again.err;
  EXPECT_EQ(run_program(folder, "study s.toml").err, "");
}

// No step is made: that case fails with what the run says, and the study goes on.
TEST(Study, AFailedCaseIsAResult) {
  const TemporaryFolder folder;
  folder.file(
      "s.toml",
      kHead +
          "[[case]]\nname = 'pulled apart'\nset = { 'integrator.max_iterations' = 1, "
          "'load.0.acceleration' = '0 0 -9e5 m/s^2', 'body.beam.geometry.box.cells' = [1, 1, 5], "
          "'body.beam.material.law' = 'neo-hookean' }\n" +
          kEnd + kExact);
  const ProgramResult result = run_program(folder, "study s.toml");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string table = content(folder / "out/s/study.csv");
  EXPECT_NE(table.find("\npulled apart,could not go on,"), std::string::npos) << table;
  const std::string text = content(folder / "out/s/study.md");
  EXPECT_NE(text.find("| pulled apart | could not go on | "), std::string::npos) << text;
}

TEST(Study, AMistypedColumnEndsItAtTheFirstCase) {
  const TemporaryFolder folder;
  folder.file("s.toml", kHead + kCells + "[[output]]\ncolumn = 'end.position.w [mm]'\nexact = 1\n");
  const ProgramResult result = run_program(folder, "study s.toml");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err.rfind("articular: s.toml: output `end.position.w [mm]`: history.csv has no "
                             "column `end.position.w [mm]`; did you mean `end.position.",
                             0),
            0u)
      << result.err;
}

// The limit leaves the scenario as it is, the other case, time even with sanitizers.
TEST(Study, ACaseThatTakesTooLongIsStopped) {
  const TemporaryFolder folder;
  folder.file("s.toml", kHead +
                            "time_limit = '4 s'\n[[case]]\nname = 'endless'\nset = { analysis "
                            "= 'dynamic', duration = '1000 s', 'integrator.step' = '1 ms' }\n" +
                            kEnd + kExact);
  EXPECT_EQ(run_program(folder, "study s.toml").exit_code, 0);
  EXPECT_NE(content(folder / "out/s/study.csv").find("\nendless,time limit,"), std::string::npos);
}

TEST(Study, ReferencesWhoseSizesAreTheWrongWayRoundAreDoubted) {
  const TemporaryFolder folder;
  const auto warning = [&](const char* finer, const char* coarser) {
    const auto reference = [](const char* size, const char* cells) {
      return std::string("[[reference]]\nsize = ") + size +
             "\nset = { 'body.beam.geometry.box.cells' = " + cells + " }\n";
    };
    folder.file("s.toml", kHead + reference("1", finer) + reference("3", coarser) + kCells + kEnd);
    return run_program(folder, "study s.toml --quiet --fresh").err;
  };
  const char* const few = "[1, 1, 5]";
  const char* const many = "[8, 8, 60]";
  EXPECT_NE(warning(few, many).find("is the smaller `size` that of the finer one?"),
            std::string::npos);
  EXPECT_EQ(warning(many, few).find("smaller `size`"), std::string::npos);
}

TEST(Study, WhereNoCaseSucceedsItSaysSo) {
  const TemporaryFolder folder;
  std::string head = kHead;
  head.insert(head.find("set = { ") + 8,
              "'integrator.max_iterations' = 1, 'load.0.acceleration' = '0 0 -9e5 m/s^2', "
              "'body.beam.material.law' = 'neo-hookean', ");
  folder.file("s.toml", head + kCells + kEnd);
  const ProgramResult result = run_program(folder, "study s.toml --quiet");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("no case succeeded, the first one: could not go on"), std::string::npos)
      << result.err;
}

TEST(Study, InterruptedItGoesOnWithWhatIsMissing) {
  const TemporaryFolder folder;
  folder.file("s.toml", kHead +
                            "[[case]]\nname = 'long'\nset = { analysis = 'dynamic', duration = "
                            "'1000 s' }\n" +
                            kEnd + kExact);
  const ProgramResult stopped =
      run_shell(folder,
                "\"$articular\" study s.toml & pid=$!; "
                "while [ ! -f out/s/cases/long/log ] && kill -0 $pid; do sleep 0.02; done; "
                "kill -TERM $pid; wait $pid");
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_NE(stopped.err.find("interrupted; the same command goes on"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/s/cases/as_it_is/case.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/s/cases/long/case.json"));
}

TEST(Study, CasesSideBySideGiveTheSameValues) {
  const TemporaryFolder folder;
  folder.file("s.toml", kHead + kCells + kEnd + kExact);
  ASSERT_EQ(run_program(folder, "study s.toml --out one").exit_code, 0);
  ASSERT_EQ(run_program(folder, "study s.toml --out two --jobs 3").exit_code, 0);
  EXPECT_NE(content(folder / "two/study.md").find("CPU time"), std::string::npos);
  const auto values = [](const std::string& table) {  // the last two columns
    std::string result;
    for (std::size_t at = 0; at < table.size(); at = table.find('\n', at) + 1) {
      const std::string line = table.substr(at, table.find('\n', at) - at);
      result += line.substr(line.rfind(',', line.rfind(',') - 1)) + "\n";
    }
    return result;
  };
  EXPECT_EQ(values(content(folder / "one/study.csv")), values(content(folder / "two/study.csv")));
}

TEST(Study, MeshesAreMadeOnceForAllThatAskForThem) {
  const TemporaryFolder folder;
  folder.file("box.toml",
              "duration = '1 s'\nanalysis = 'static'\n[integrator]\nstep = '1 s'\n"
              "[[body]]\nname = 'wall'\nkind = 'fixed'\nmesh = { file = "
              "'${ARTICULAR_PREPARED}/fossa_left.vtp' }\n"
              "[[probe]]\nname = 'wall'\nkind = 'reaction'\nbody = 'wall'\n");
  folder.file("s.toml",
              "scenario = 'box.toml'\n"
              "prepare = ['anatomy', 'mandible', '--size', '2', '--out', "
              "'${ARTICULAR_PREPARED}']\n"
              "[[knob]]\nname = 'interval'\npath = 'output.interval'\nvalues = ['0.5 s']\n"
              "[[output]]\ncolumn = 'wall.force.z [N]'\nexact = 0\nscale = 1\n");
  const ProgramResult result = run_program(folder, "study s.toml");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto prepared = std::filesystem::directory_iterator(folder / "out/s/prepared");
  EXPECT_EQ(std::distance(begin(prepared), end(prepared)), 1);
}

struct StudyMistake {
  std::string name, text, message;
};

void PrintTo(const StudyMistake& mistake, std::ostream* stream) { *stream << mistake.name; }

class StudyMistakes : public testing::TestWithParam<StudyMistake> {};

TEST_P(StudyMistakes, AreRefusedBeforeAnythingRuns) {
  const TemporaryFolder folder;
  folder.file("s.toml", GetParam().text);
  const ProgramResult result = run_program(folder, "study s.toml");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "articular: " + GetParam().message + "\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "out/s/cases"));
}

INSTANTIATE_TEST_SUITE_P(
    All, StudyMistakes,
    testing::Values(
        StudyMistake{"NoOutput", kHead, "s.toml:1:1: study: `output` is missing"},
        StudyMistake{
            "ExactOfSomeOutputs",
            kHead + kEnd + kExact + "[[output]]\ncolumn = 'end.position.x [mm]'\n",
            "s.toml:1:1: what is right is known of some outputs only; expected "
            "[[reference]] (one converged run, or three of different `size` to extrapolate "
            "from), or `exact` in every [[output]], or in none"},
        StudyMistake{
            "HistoryOfASweep", kHead + kEnd + "value = 'history'\n",
            "s.toml:3:1: `output[0]`: a `scale`, or the difference from a history, needs a "
            "[[reference]], and the study has none"},
        StudyMistake{"UnknownPath",
                     kHead + "[[case]]\nname = 'a'\nset = { duratoin = '1 s' }\n" + kEnd + kExact,
                     "--set duratoin=\"1 s\": scenario: unknown key `duratoin`; did you mean "
                     "`duration`? (case `a` of s.toml)"},
        StudyMistake{"TwoOfAName", kHead + "[[case]]\nname = 'as it is'\n" + kEnd + kExact,
                     "s.toml: two cases are called `as it is`; expected different names of knobs, "
                     "choices and cases"},
        StudyMistake{"TwoOfAPath",
                     kHead + "[[knob]]\nname = 'a'\npath = 'duration'\nvalues = ['1 s']\n" +
                         "[[knob]]\nname = 'b'\npath = 'duration'\nvalues = ['2 s']\n" + kEnd +
                         kExact,
                     "s.toml:7:1: `a` changes `duration` too; expected one of them to change it"},
        StudyMistake{"NoSize", kHead + kEnd + "[[reference]]\nsize = 1\n[[reference]]\n",
                     "s.toml:8:1: [[reference]]: `size` is missing"},
        StudyMistake{"ExactHistory", kHead + kEnd + "value = 'history'\nexact = 1.0\n",
                     "s.toml:7:9: `exact`: a history has no single right value; expected a "
                     "[[reference]]"}),
    [](const auto& info) { return info.param.name; });

}  // namespace articular::study_test
