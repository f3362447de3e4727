// The manual page and the completions, of the program as it is.
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "tests/tools/support/program.hpp"
#include "tools/manual/shell_completion.hpp"

namespace articular::manual_test {

using Words = std::set<std::string>;

Words lines_of(const std::string& text) {
  Words lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) lines.insert(line);
  return lines;
}

/// What bash offers for the last of these words, as it splits a line into them.
Words offered(const TemporaryFolder& folder, const std::string& words) {
  folder.file("complete.bash",
              "source <(\"$articular\" manual bash)\n"
              "COMP_WORDS=(articular " +
                  words +
                  ")\n"
                  "COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
                  "_articular\n"
                  "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
  const ProgramResult result = run_shell(folder, "bash complete.bash");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  return lines_of(result.out);
}

/// The names in the list of subcommands that the help ends with.
Words subcommands_in_help(const TemporaryFolder& folder) {
  const std::string help = run_program(folder, "--help").out;
  std::istringstream lines(help.substr(help.find("Subcommands:\n")));
  Words names;
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line) && line.starts_with("  ");)
    if (line[2] != ' ') names.insert(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

/// True where this machine does not have the program.
bool lacks(const std::string& program) {
  return run_shell(TemporaryFolder(), "command -v " + program).exit_code != 0;
}

TEST(BashCompletion, OffersTheSubcommandsOfTheHelp) {
  const TemporaryFolder folder;
  const Words names = subcommands_in_help(folder);
  EXPECT_TRUE(names.contains("run"));
  EXPECT_EQ(offered(folder, "''"), names);
  EXPECT_EQ(offered(folder, "ver"), Words{"verify"});
  EXPECT_EQ(offered(folder, "anatomy ''"), (Words{"knee", "mandible"}));
}

TEST(BashCompletion, OffersTheOptionsOfASubcommand) {
  const TemporaryFolder folder;
  EXPECT_EQ(offered(folder, "run scene.toml --re"), (Words{"--reproducible", "--resume"}));
  EXPECT_EQ(offered(folder, "anatomy knee --lay"), Words{"--layers"});
  EXPECT_EQ(offered(folder, "explain --no"), Words{"--no-costs"});
}

TEST(BashCompletion, OffersFilesOfTheKindAndFolders) {
  const TemporaryFolder folder;
  for (const char* name : {"scene.toml", "bone.stl", "bone.obj", "notes.txt"})
    folder.file(name, "");
  std::filesystem::create_directory(folder / "out");
  EXPECT_EQ(offered(folder, "run ''"), (Words{"scene.toml", "out"}));
  EXPECT_EQ(offered(folder, "mesh b"), (Words{"bone.obj", "bone.stl"}));
  EXPECT_EQ(offered(folder, "run scene.toml --out ''"), Words{"out"});
}

TEST(BashCompletion, OffersTheWordsThatAValueMayBe) {
  const TemporaryFolder folder;
  EXPECT_EQ(offered(folder, "collide a.vtu --narrow ''"), (Words{"gjk", "sat"}));
  EXPECT_EQ(offered(folder, "render out --field von"), Words{"von_mises"});
  EXPECT_EQ(offered(folder, "manual f"), Words{"fish"});
}

// Bash takes "=" for a word of its own.
TEST(BashCompletion, GoesOnBehindAnEqualsSign) {
  const TemporaryFolder folder;
  EXPECT_EQ(offered(folder, "collide a.vtu --narrow ="), (Words{"gjk", "sat"}));
  EXPECT_EQ(offered(folder, "collide a.vtu --narrow = g"), Words{"gjk"});
  EXPECT_EQ(offered(folder, "run a.toml --set accuracy = b"), Words{"balanced"});
  EXPECT_EQ(offered(folder, "run a.toml --set acc"),
            (Words{"accuracy=accurate", "accuracy=balanced", "accuracy=fast"}));
}

// Whatever program this is: `articular scenarios` of a stand-in lists a scenario and a study.
TEST(BashCompletion, OffersShippedScenariosBesideFilesButNoStudies) {
  const TemporaryFolder folder;
  const tools::Argument scenario{
      {"scenario"}, "TEXT", "File (.toml), or a name: see `articular scenarios`", true, false};
  const tools::Command run{"run", "", "", {scenario}, {}, {}};
  folder.file("completion.bash", tools::bash_completion({"articular", "", "", {}, {}, {run}}));
  folder.file("articular",
              "#!/bin/sh\necho 'knee/flexion  static  A'\necho 'knee/cost  study  B'\n");
  folder.file("kneeling.toml", "");
  const ProgramResult result = run_shell(
      folder,
      "chmod +x articular; PATH=$PWD:$PATH bash -c 'source completion.bash; COMP_CWORD=2; "
      "COMP_WORDS=(articular run kne); _articular; printf \"%s\\n\" \"${COMPREPLY[@]}\"'");
  EXPECT_EQ(lines_of(result.out), (Words{"kneeling.toml", "knee/flexion"})) << result.err;
}

TEST(FishCompletion, OffersSubcommandsAndWords) {
  if (lacks("fish")) GTEST_SKIP() << "no fish here";
  const TemporaryFolder folder;
  const auto completed = [&](const std::string& line) {
    return run_shell(folder,
                     "\"$articular\" manual fish > c.fish; fish --no-config -c 'source c.fish; "
                     "complete --do-complete \"articular " +
                         line + "\"'")
        .out;
  };
  EXPECT_NE(completed("").find("run\tRun a scenario"), std::string::npos);
  EXPECT_TRUE(completed("render out --view to").starts_with("top\t"));
  EXPECT_NE(completed("anatomy knee --l").find("--layers"), std::string::npos);
}

TEST(ZshCompletion, IsAValidScript) {
  if (lacks("zsh")) GTEST_SKIP() << "no zsh here";
  const ProgramResult result =
      run_shell(TemporaryFolder(), "\"$articular\" manual zsh > _articular; zsh -n _articular");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
}

TEST(ManualPage, TellsOfEverySubcommand) {
  const TemporaryFolder folder;
  const ProgramResult page = run_program(folder, "manual");
  EXPECT_EQ(page.exit_code, 0);
  for (const std::string& name : subcommands_in_help(folder))
    EXPECT_NE(page.out.find("\n.SS articular " + name), std::string::npos) << name;
  EXPECT_NE(page.out.find("\\fB\\-\\-error\\-bars\\fR"), std::string::npos);
  const std::string version = run_program(folder, "--version").out;
  EXPECT_NE(page.out.find("\"articular " + version.substr(0, version.find('\n')) + "\""),
            std::string::npos);
}

TEST(ManualPage, IsWellFormed) {
  if (lacks("mandoc")) GTEST_SKIP() << "no mandoc here";
  const ProgramResult lint =
      run_shell(TemporaryFolder(), "\"$articular\" manual > a.1; mandoc -T lint -W warning a.1");
  EXPECT_EQ(lint.exit_code, 0) << lint.out;
}

TEST(Manual, RefusesAnotherFormat) {
  const ProgramResult result = run_program(TemporaryFolder(), "manual html");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("unknown format `html`: expected man, bash, zsh or fish"),
            std::string::npos)
      << result.err;
}

}  // namespace articular::manual_test
