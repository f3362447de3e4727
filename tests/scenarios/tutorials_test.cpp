// The tutorials, from their text: what is to be saved is saved, and what is to be typed is typed.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <utility>
#include <vector>

#include "tests/tools/support/program.hpp"

namespace articular::tutorials_test {

const std::filesystem::path kTutorials =
    std::filesystem::path(ARTICULAR_SOURCE_DIR) / "scenarios/tutorials";

struct Tutorial {
  std::vector<std::pair<std::string, std::string>> files;  // name, text
  std::vector<std::string> commands;                       // lines indented by four blanks
};

/// The name in "save this as `bite.toml`", with which a paragraph may end; else "".
std::string name_to_save(const std::string& paragraph) {
  const std::size_t words = paragraph.find("ave this as");
  if (words == std::string::npos) return "";
  const std::size_t begin = paragraph.find('`', words);
  const std::size_t end = paragraph.find('`', begin + 1);
  return end == std::string::npos ? "" : paragraph.substr(begin + 1, end - begin - 1);
}

Tutorial read_tutorial(const std::filesystem::path& page) {
  Tutorial tutorial;
  std::istringstream lines(content(page));
  std::string paragraph, before;  // a block stands behind an empty line
  bool is_in_block = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      is_in_block = !is_in_block;
      if (is_in_block) tutorial.files.emplace_back(name_to_save(before), "");
    } else if (is_in_block) {
      tutorial.files.back().second += line + "\n";
    } else if (line.starts_with("    ")) {
      tutorial.commands.push_back(line.substr(4));
    } else if (line.empty()) {
      before = paragraph;
      paragraph.clear();
    } else {
      paragraph += line + " ";
    }
  }
  return tutorial;
}

class TutorialPage : public testing::TestWithParam<const char*> {};

TEST_P(TutorialPage, RunsAsItStands) {
  const Tutorial tutorial = read_tutorial(kTutorials / GetParam());
  EXPECT_FALSE(tutorial.files.empty());
  EXPECT_GE(tutorial.commands.size(), 2U);
  const TemporaryFolder folder;
  for (const auto& [name, text] : tutorial.files) {
    ASSERT_NE(name, "") << "a block without \"save this as\":\n" << text;
    folder.file(name, text);
  }
  const std::string in_path = "PATH=\"$(dirname \"$articular\"):$PATH\"; ";
  for (const std::string& command : tutorial.commands) {
    const ProgramResult result = run_shell(folder, in_path + command);
    ASSERT_EQ(result.exit_code, 0) << command << "\n" << result.err;
  }
}

constexpr const char* kPages[] = {
#ifdef ARTICULAR_MESHER
    "two-surfaces.md", "own-knee.md",
#endif
    "paraview.md", "accuracy.md", "from-febio.md"};
INSTANTIATE_TEST_SUITE_P(Tutorials, TutorialPage, testing::ValuesIn(kPages));

double last_value(const std::filesystem::path& history, const std::string& column) {
  std::istringstream lines(content(history));
  std::string header, line, last, cell;
  std::getline(lines, header);
  while (std::getline(lines, line)) last = line;
  std::istringstream names(header), cells(last);
  for (std::string name; std::getline(names, name, ',') && std::getline(cells, cell, ',');)
    if (name == column) return std::stod(cell);
  ADD_FAILURE() << "no column " << column;
  return 0;
}

// ParaView itself draws by the state where it is installed.
TEST(Tutorials, TheStateOfParaViewDrawsARun) {
  const TemporaryFolder folder;
  const Tutorial tutorial = read_tutorial(kTutorials / "paraview.md");
  const auto& [name, state] = tutorial.files.at(0);
  folder.file(name, state);
  const ProgramResult compiled = run_shell(folder, "python3 -m py_compile " + name);
  EXPECT_EQ(compiled.exit_code, 0) << compiled.err;
  const ProgramResult run =
      run_program(folder, "run mandible/opening --quiet --set duration=\"1 ms\" --out out/opening");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string tissue = content(folder / "out/opening/frames/disc_left_000000.vtu");
  EXPECT_NE(tissue.find("Name=\"von_mises\""), std::string::npos);
  const std::string lines = content(folder / "out/opening/frames/lines_000000.vtp");
  EXPECT_NE(lines.find("Name=\"force\""), std::string::npos);
  if (run_shell(folder, "command -v pvpython").exit_code != 0) GTEST_SKIP() << "no ParaView";
  const ProgramResult drawn = run_shell(folder, "QT_QPA_PLATFORM=offscreen xvfb-run -a pvpython " +
                                                    name + " out/opening/opening.pvd picture.png");
  EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_EQ(content(folder / "picture.png").substr(1, 3), "PNG");
}

// Forces that accuracy.md quotes.
TEST(Tutorials, ThePresetsGiveTheForcesThatThePageSays) {
  const Tutorial tutorial = read_tutorial(kTutorials / "accuracy.md");
  const TemporaryFolder folder;
  folder.file(tutorial.files.at(0).first, tutorial.files.at(0).second);
  const std::pair<const char*, double> presets[] = {
      {"fast", 0.608}, {"balanced", 0.618}, {"accurate", 0.619}};
  for (const auto& [preset, force] : presets) {
    const std::string name = preset;
    run_program(folder, "run block.toml --quiet --set accuracy=" + name + " --out " + name);
    EXPECT_NEAR(last_value(folder / (name + "/history.csv"), "plate.force.z [N]"), force, 6e-4);
  }
}

}  // namespace articular::tutorials_test
