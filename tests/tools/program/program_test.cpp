// The program as a user meets it: exit codes, one clear line on stderr, nothing half-written.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

#include "tests/support/address_sanitizer.hpp"
#include "tests/tools/support/program.hpp"

namespace articular::program_test {

const std::string kRun = "run scene.toml --out out --quiet";

const std::string kTissue = R"(
duration = "2 ms"
[[body]]
name = "floor"
kind = "fixed"
[[body]]
name = "disc"
kind = "tissue"
density = "1 g/cm^3"
material = { law = "linear", young_modulus = "5 MPa", poisson_ratio = 0.3, element = "plain" }
)";
const std::string kScene =
    kTissue + "geometry = { box = { size = \"4 4 4 mm\", cells = [2, 2, 2] } }\n";

std::string with(const std::string& text, const std::string& from, const std::string& to) {
  std::string changed = text;
  const std::size_t at = changed.find(from);
  if (at == std::string::npos) throw std::invalid_argument("no " + from);
  return changed.replace(at, from.size(), to);
}

std::string with_mesh(const std::string& file) {
  return kTissue + "mesh = { file = \"" + file + "\" }\n";
}

const std::string kNodes = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 1, 1, 0\n";

struct BadInput {
  const char* name;
  std::string scene;
  const char* fragment;  // of the message
};

void PrintTo(const BadInput& input, std::ostream* out) { *out << input.name; }

class BadInputs : public ::testing::TestWithParam<BadInput> {};

std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

TEST(Check, TellsWhichBodiesOverlapAtTheStartAndByHowMuch) {
  const TemporaryFolder folder;
  const std::string block =
      "geometry = { box = { size = \"4 4 4 mm\", cells = [2, 2, 2], center = \"1 1 3.9 mm\" } }\n";
  std::string other = kTissue.substr(kTissue.rfind("[[body]]"));
  other = with(other, "disc", "upper");
  folder.file("scene.toml", kScene + other + block);
  const ProgramResult result = run_program(folder, "check scene.toml");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("`disc` and `upper` overlap at the start by 0.1 mm"), std::string::npos)
      << result.out;
}

/// A plate is driven onto a sheet, of which every node is held.
const std::string kSheetAndPlate = R"(
duration = "1 s"
analysis = "static"
[[body]]
name = "frame"
kind = "fixed"
[[body]]
name = "sheet"
kind = "tissue"
density = "1 g/cm^3"
material = { law = "linear", young_modulus = "5 MPa", poisson_ratio = 0.3, element = "plain" }
geometry = { box = { size = "10 10 2 mm", cells = [3, 3, 1], center = "0 0 -1 mm" } }
[[body]]
name = "plate"
kind = "fixed"
geometry = { box = { size = "6 6 2 mm", cells = [2, 2, 1], center = "0 0 1.2 mm" } }
[[attach]]
body = "sheet"
to = "frame"
region = { box = ["-6 -6 -3 mm", "6 6 1 mm"] }
[[load]]
kind = "motion"
body = "plate"
time = ["0 s", "1 s"]
translation = ["0 0 0 mm", "0 0 -6 mm"]
)";

TEST(Check, ContactShowsPairsAndSurfaces) {
  const TemporaryFolder folder;
  folder.file("scene.toml", kSheetAndPlate);
  const ProgramResult result = run_program(folder, "check scene.toml --contact");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* words : {"non-mortar side", "near, 0.2 mm", "flat elements"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words << "\n" << result.out;
}

TEST(Check, DiagnoseNamesTheContactThatMakesAStepFail) {
  const TemporaryFolder folder;
  folder.file("scene.toml", kSheetAndPlate);
  const ProgramResult result = run_program(folder, "check scene.toml --diagnose");
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_NE(result.out.find("contact of `sheet` and `plate` makes it fail"), std::string::npos)
      << result.out;
  EXPECT_NE(result.err.find("diagnose: without contact"), std::string::npos) << result.err;
  EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{".stderr", ".stdout", "scene.toml"}));
  const ProgramResult run = run_program(folder, "run scene.toml --quiet --out out");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("surfaces go through each other in a step of"), std::string::npos)
      << run.err;
  const ProgramResult sound = run_program(
      folder,
      "check scene.toml --diagnose --set load.0.translation='[\"0 0 0 mm\", \"0 0 1 mm\"]'");
  EXPECT_EQ(sound.exit_code, 0) << sound.err;
  EXPECT_NE(sound.out.find("no step failed until t = 1 s, the end"), std::string::npos)
      << sound.out;
}

// What `check` prints of an overlap that stays `run` says too, in its summary as well.
TEST(Check, AndRunAgreeOnOverlaps) {
  const TemporaryFolder folder;
  std::string scene = kSheetAndPlate;
  scene = with(scene, "0 0 1.2 mm", "0 0 0.999 mm");
  scene = with(scene, "0 0 -6 mm", "0 0 1 mm");
  folder.file("scene.toml", scene);
  const ProgramResult check = run_program(folder, "check scene.toml");
  const std::size_t at = check.out.find("`sheet` and `plate` overlap at the start by 0.001 mm");
  ASSERT_NE(at, std::string::npos) << check.out;
  const std::string words = check.out.substr(at, check.out.find('\n', at) - at);
  EXPECT_NE(words.find("`run` starts so, pressed together"), std::string::npos) << words;
  const ProgramResult run = run_program(folder, "run scene.toml --quiet --out out");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("warning: " + words), std::string::npos) << run.err;
  EXPECT_NE(content(folder / "out/summary.json").find(words), std::string::npos);
}

nlohmann::json summary_of(const TemporaryFolder& folder, const std::string& arguments) {
  EXPECT_EQ(run_program(folder, kRun + " --overwrite " + arguments).exit_code, 0) << arguments;
  return nlohmann::json::parse(content(folder / "out/summary.json"));
}

TEST(Run, SummaryNamesWhatTheLastBitsDependOn) {
  const TemporaryFolder folder;
  folder.file("scene.toml", kScene);
  const auto first = summary_of(folder, ""), again = summary_of(folder, ""),
             other = summary_of(folder, "--set body.disc.density='2 g/cm^3'");
  EXPECT_EQ(first.at("inputs"), again.at("inputs"));
  EXPECT_NE(first.at("inputs"), other.at("inputs"));
  const std::set<std::string> sets = {"sse2", "avx2", "avx512f"};
  EXPECT_TRUE(sets.contains(first.at("processor").at("instruction_set")));
  EXPECT_FALSE(first.at("processor").at("blas_kernels").get<std::string>().empty());
  EXPECT_EQ(first.at("processor").at("reproducible"), false);
  for (const char* library : {"OpenBLAS", "CHOLMOD", "glibc", "SUNDIALS", "Eigen"})
    EXPECT_NE(first.at("versions").at(library).get<std::string>().find('.'), std::string::npos)
        << library;
  // Files are told with a hash of their bytes: FNV-1a, by its definition.
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : kScene) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  ASSERT_EQ(first.at("input_files").size(), 1U);
  EXPECT_EQ(first.at("input_files")[0].at("file"), "scene.toml");
  EXPECT_EQ(first.at("input_files")[0].at("bytes"), kScene.size());
  EXPECT_EQ(first.at("input_files")[0].at("fnv1a_64"), fmt::format("{:016x}", hash));
  EXPECT_NE(first.at("build").at("compiler").get<std::string>().find('.'), std::string::npos);
  EXPECT_NE(first.at("build").at("flags").get<std::string>().find("-O"), std::string::npos);
}

TEST(Check, ShowsWhatWasUnderstood) {
  const TemporaryFolder folder;
  folder.file("scene.toml", kScene + R"(
[[body]]
name = "bone"
kind = "rigid"
geometry = { box = { size = "2 2 2 mm", cells = [1, 1, 1], center = "20 0 0 mm" } }
density = "2 g/cm^3"
[[body]]
name = "stone"
kind = "rigid"
geometry = { box = { size = "2 2 2 mm", cells = [1, 1, 1], center = "40 0 0 mm" } }
density = "2 g/cm^3"
[[attach]]
body = "disc"
to = "floor"
region = { box = ["-9 -9 -2.1 mm", "9 9 -1.9 mm"] }
[[support]]
name = "side"
body = "disc"
region = { box = ["1.9 -9 -1 mm", "9 9 9 mm"] }
freedoms = ["translation.x"]
[[load]]
kind = "pressure"
body = "disc"
region = { box = ["-9 -9 1.99 mm", "9 9 9 mm"] }
pressure = "2 kPa"
[[muscle]]
name = "lip"
path = [{ body = "floor", point = "20 0 10 mm" }, { body = "bone", point = "20 0 1 mm" }]
max_force = "3 N"
optimal_length = "6 mm"
[[ligament]]
name = "band"
path = [{ body = "floor", point = "30 0 0 mm" }, { body = "bone", point = "21 0 0 mm" }]
stiffness = "2 N/mm"
slack_length = "8 mm"
[[ligament]]
name = "through"
path = [{ body = "floor", point = "20 0.4 8 mm" }, { body = "floor", point = "20 0.4 -8 mm" }]
stiffness = "2 N/mm"
slack_length = "20 mm"
[[ligament]]
name = "over"
path = [{ body = "floor", point = "20 0.4 8 mm" }, { body = "floor", point = "20 0.4 -8 mm" }]
wrap = ["bone"]
stiffness = "2 N/mm"
slack_length = "20 mm"
)");
  const ProgramResult result = run_program(folder, "check scene.toml");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const std::string row :
       {"disc                 tissue       4.0 x 4.0 x 4.0 at (0.0 0.0 0.0)                 0.064  "
        "   "
        "0.064        48   45.0",
        "bone                 rigid        2.0 x 2.0 x 2.0 at (20.0 0.0 0.0)                0.008  "
        "   "
        "0.016         -      -",
        "disc                 to floor                9 of 27 nodes, between (-2.0 -2.0 -2.0) and "
        "(2.0 2.0 -2.0) mm",
        "disc                 by side                 6 of 27 nodes, between (2.0 -2.0 0.0) and "
        "(2.0 2.0 2.0) mm, held along (1.00 0.00 0.00)",
        "disc                 under pressure          8 faces, 16 mm^2, in all (0 0 -0.032) N",
        "9.00  ( 0.00  0.00 -1.00)", "3 N, 6.00 mm",
        "9.00  (-1.00  0.00  0.00)          2  8.00 mm, +12.50 %\n",
        "16.00  ( 0.00  0.00 -1.00)          0  20.00 mm, -20.00 %, 0.6 mm deep through `bone`\n",
        ", around `bone`\n",
        "At the start, where nothing presses yet, nothing but inertia resists: body `stone` can "})
    EXPECT_NE(result.out.find(row), std::string::npos) << row << "\n" << result.out;
}

TEST(Check, DoubtsUnits) {
  const TemporaryFolder folder;
  folder.file("scene.toml",
              with(with(kScene, "1 g/cm^3", "1000 g/cm^3"), "4 4 4 mm", "1600 4 4 mm"));
  const ProgramResult result = run_program(folder, "check scene.toml");
  EXPECT_EQ(result.exit_code, 0);
  for (const std::string doubt :
       {"scene.toml:6:1: `disc` is 1.6e+03 mm long; is its unit the one that was meant?",
        "`disc` has a density of 1e+06 kg/m^3, 1e+03 times that of water"})
    EXPECT_NE(result.out.find(doubt), std::string::npos) << result.out;
}

TEST(Check, TellsOfAllMistakesAtOnce) {
  const TemporaryFolder folder;
  folder.file("scene.toml", with(with(kScene, "2 ms", "2 mm"), "density", "densty"));
  const ProgramResult result = run_program(folder, "check scene.toml");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("articular: scene.toml:2:12: `duration`"), std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("\narticular: scene.toml:9:1: body `disc`: unknown key `densty`"),
            std::string::npos)
      << result.err;
}

TEST_P(BadInputs, GiveOneClearLineAndExitCode2AndWriteNothing) {
  const TemporaryFolder folder;
  folder.file("scene.toml", GetParam().scene);
  folder.file("inverted.inp", kNodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n2, 2, 3, 5, 4\n");
  folder.file("flat.inp", kNodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 5\n");
  folder.file("surface.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::set<std::string> before = names_in(folder.path());
  before.insert({".stdout", ".stderr"});
  for (const std::string& arguments : {kRun, std::string("check scene.toml")}) {
    const ProgramResult result = run_program(folder, arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(GetParam().fragment), std::string::npos) << result.err;
    EXPECT_EQ(names_in(folder.path()), before) << arguments;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Program, BadInputs,
    ::testing::Values(
        BadInput{"WrongToml", with(kScene, "kind = \"fixed\"", "kind = \"fixed"), "scene.toml:5:"},
        BadInput{"UnknownKey", with(kScene, "density", "densty"), "density"},
        BadInput{"WrongUnit", with(kScene, "5 MPa", "5 mm"), "scene.toml:10:"},
        BadInput{"MissingUnit", with(kScene, "\"1 g/cm^3\"", "1000"), "scene.toml:9:"},
        BadInput{"NotFinite", with(kScene, "0.3", "nan"), "scene.toml:10:"},
        BadInput{"NegativeDensity", with(kScene, "1 g/cm^3", "-1 g/cm^3"), "scene.toml:9:"},
        BadInput{"PoissonRatioOfOneHalf", with(kScene, "0.3", "0.5"), "scene.toml:10:"},
        BadInput{"UnknownBody",
                 kScene + "[[attach]]\nbody = \"disk\"\nto = \"floor\"\nregion = {}\n", "disc"},
        BadInput{"MuscleWithoutInsertion",
                 kScene + "[[muscle]]\nname = \"lip\"\nmax_force = \"1 N\"\n"
                          "path = [{ body = \"floor\", point = \"0 0 0 mm\" }]\n",
                 "scene.toml:15:"},
        BadInput{"NoSuchMesh", with_mesh("nothing.vtu"), "nothing.vtu"},
        BadInput{"InvertedElement", with_mesh("inverted.inp"), "is inverted"},
        BadInput{"FlatElement", with_mesh("flat.inp"), "is flat"},
        BadInput{"MeshWithoutTetrahedra", with_mesh("surface.obj"), "no tetrahedra"}),
    [](const auto& info) { return std::string(info.param.name); });

// A name with an escape sequence would be obeyed by the terminal.
TEST(Program, SaysNothingThatATerminalObeys) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_shell(folder, R"sh("$articular" check "$(printf '\033[2Ja\001.toml')")sh");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("[2Ja .toml: no such file"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find('\033'), std::string::npos);
}

TEST(Program, MissingScenarioIsBadInput) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(folder, "run nothing.toml --out out");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find("nothing.toml"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(Program, AFirstWordThatIsNoSubcommandIsNamed) {
  const TemporaryFolder folder;
  const std::string err = run_program(folder, "walk scene.toml").err;
  EXPECT_EQ(err.find("articular: no subcommand `walk`; expected one of `run`, "), 0U) << err;
  EXPECT_EQ(run_program(folder, "rendr out").err,
            "articular: no subcommand `rendr`; did you mean `render`? (see --help)\n");
}

TEST(Program, WrongArgumentsAreBadInput) {
  const TemporaryFolder folder;
  folder.file("scene.toml", kScene);
  for (const char* arguments :
       {"", "walk", "run", "run scene.toml --sett x=1", "run scene.toml --set x=1",
        "run scene.toml --set duration=1", "run scene.toml --set duration"}) {
    const ProgramResult result = run_program(folder, arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(Program, FolderThatCannotBeWrittenIsAFailureOfTheSystem) {
  const TemporaryFolder folder;
  folder.file("scene.toml", kScene);
  folder.file("file", "");
  const ProgramResult result = run_program(folder, "run scene.toml --out file/out --quiet");
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find("file/out"), std::string::npos) << result.err;
}

TEST(Program, FinishedRunNamesItsFilesAndHasThemWhole) {
  const TemporaryFolder folder;
  folder.file("scene.toml", kScene);
  const ProgramResult result = run_program(folder, kRun);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out, "out/scene.pvd\nout/history.csv\nout/summary.json\n");
  for (const char* file : {"out/scene.pvd", "out/history.csv", "out/summary.json"})
    EXPECT_FALSE(content(folder / file).empty()) << file;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "out"))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

TEST(Program, WarnsOfAMuscleThatCanHardlyPull) {
  const TemporaryFolder folder;
  folder.file("scene.toml",
              kScene +
                  "[[muscle]]\nname = \"lip\"\nmax_force = \"1 N\"\noptimal_length = \"5 mm\"\n"
                  "excitation = { time = [\"0 s\"], value = [1] }\n"
                  "path = [{ body = \"floor\", point = \"0 0 0 mm\" }, "
                  "{ body = \"roof\", point = \"0 0 10 mm\" }]\n"
                  "[[body]]\nname = \"roof\"\nkind = \"fixed\"\n");
  const ProgramResult result = run_program(folder, kRun);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find("warning: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("lip"), std::string::npos) << result.err;
}

// One Newton iteration a step does not reach this tolerance, however short the step.
TEST(Program, RunThatCannotGoOnLeavesValidResults) {
  const TemporaryFolder folder;
  folder.file(
      "scene.toml",
      with(kScene, "[[body]]",
           "[integrator]\nmax_iterations = 1\nposition_tolerance = \"1e-9 um\"\n[[body]]") +
          "[[load]]\nkind = \"gravity\"\nacceleration = \"0 0 -9.81 m/s^2\"\n"
          "[[load]]\nkind = \"force\"\nbody = \"disc\"\nregion = { box = [\"-3 -3 1.9 mm\", "
          "\"3 3 2.1 mm\"] }\nforce = \"30 0 30 N\"\n");
  const ProgramResult result =
      run_program(folder, kRun + " --set body.disc.material.law=neo-hookean");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find("results are valid until then"), std::string::npos) << result.err;
  EXPECT_NE(content(folder / "out/summary.json").find("cannot go on"), std::string::npos);
  EXPECT_NE(content(folder / "out/scene.pvd").find("disc_000000.vtu"), std::string::npos);
}

TEST(Program, AnErrorOnATerminalShowsTheLineWithACaret) {
  const TemporaryFolder folder;
  folder.file("scene.toml", "duration = 5\n");
  const ProgramResult terminal =
      run_shell(folder, "script -qec '\"$articular\" check scene.toml' /dev/null");
  EXPECT_NE(terminal.out.find("    1 | duration = 5\r\n      |            ^\r\n"),
            std::string::npos)
      << terminal.out;
  EXPECT_EQ(run_program(folder, "check scene.toml").err.find('^'), std::string::npos);
}

TEST(Program, HelpNamesEverySubcommand) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(folder, "--help");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  for (const char* command :
       {"run", "scenarios", "keys", "check", "explain", "render", "plot", "report", "study", "work",
        "fit", "track", "verify", "collide", "mesh", "anatomy", "manual"}) {
    EXPECT_NE(result.out.find(std::string("  ") + command + " "), std::string::npos) << command;
    const ProgramResult own = run_program(folder, std::string(command) + " --help");
    EXPECT_EQ(own.exit_code, 0) << command;
    EXPECT_NE(own.out.find("Usage: articular " + std::string(command)), std::string::npos)
        << own.out;
  }
}

TEST(Program, AMissingMeshIsToldWithWhatMakesIt) {
  const TemporaryFolder folder;
  folder.file("s.toml",
              "duration = \"1 s\"\n"
              "[[body]]\n"
              "name = \"bone\"\n"
              "kind = \"fixed\"\n"
              "mesh = { file = \"bone.vtp\", made_by = \"tools/make-bone\" }\n");
  const ProgramResult result = run_program(folder, "check s.toml");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("s.toml:5:"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("no such mesh file; it is made by `tools/make-bone`"),
            std::string::npos)
      << result.err;
}

// What is measured of a scene before it runs, beside what it then takes.
TEST(Program, ExplainMeasuresTermsAndMemory) {
  const TemporaryFolder folder;
  const std::string scene = "'" ARTICULAR_SOURCE_DIR "/scenarios/verification/tool_on_tissue.toml'";
  const ProgramResult result = run_program(folder, "explain " + scene + " --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  double share = 0, forces = 0;
  for (const auto& term : json.at("costs").at("terms")) {
    forces += term.value("evaluation_s", 0.0);
    if (term.contains("share_of_unknowns")) share += term.at("share_of_unknowns").get<double>();
  }
  EXPECT_GT(forces, 0);
  EXPECT_NEAR(share, 1, 1e-12);  // the tool is driven
  EXPECT_GT(json.at("costs").at("iteration_s").at("factor").get<double>(), 0);
  EXPECT_GT(json.at("costs").at("longest_explicit_step_s").get<double>(), 0);

  if (!has_address_sanitizer()) {
    ASSERT_EQ(
        run_program(folder, "run " + scene + " --quiet --out out --set duration='10 ms'").exit_code,
        0);
    const double needed =
        nlohmann::json::parse(content(folder / "out/summary.json")).at("peak_memory_MB");
    EXPECT_LT(json.at("costs").at("estimated_memory_MB").get<double>(), 1.5 * needed);
    EXPECT_GT(json.at("costs").at("estimated_memory_MB").get<double>(), needed / 1.5);
  }

  const ProgramResult plain = run_program(folder, "explain " + scene + " --json --no-costs");
  EXPECT_FALSE(nlohmann::json::parse(plain.out).contains("costs"));
  const ProgramResult text = run_program(folder, "explain " + scene);
  EXPECT_NE(text.out.find("elasticity of `layer`"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("`explicit` would be stable"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("Accuracy: within "), std::string::npos) << text.out;
}

TEST(Program, FoodIsListed) {
  const TemporaryFolder folder;
  folder.file(
      "s.toml",
      "duration = \"10 ms\"\n"
      "integrator.step = \"1 ms\"\n"
      "[[body]]\n"
      "name = \"skull\"\n"
      "kind = \"fixed\"\n"
      "geometry = { box = { size = \"1 1 1 cm\", cells = [1, 1, 1], center = \"0 0 3 cm\" } }\n"
      "[[body]]\n"
      "name = \"jaw\"\n"
      "kind = \"rigid\"\n"
      "density = \"1 g/cm^3\"\n"
      "geometry = { box = { size = \"1 1 1 cm\", cells = [1, 1, 1] } }\n"
      "[[bolus]]\n"
      "name = \"carrot\"\n"
      "path = [{ body = \"skull\", point = \"0 0 25 mm\" }, { body = \"jaw\", point = \"0 "
      "0 5 mm\" }]\n"
      "depth = [\"0 mm\", \"1.5 mm\"]\n"
      "force = [\"0 N\", \"66 N\"]\n"
      "unloading_stiffness = \"200 N/mm\"\n");
  const ProgramResult explained = run_program(folder, "explain --no-costs --json s.toml");
  ASSERT_EQ(explained.exit_code, 0) << explained.err;
  EXPECT_EQ(nlohmann::json::parse(explained.out).at("boluses"), 1);
  const ProgramResult checked = run_program(folder, "check s.toml");
  ASSERT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_NE(checked.out.find("what is between its points, 0 s, 66 N"), std::string::npos)
      << checked.out;
}

}  // namespace articular::program_test
