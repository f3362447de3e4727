// `articular keys`: the reference of keys and the schema for editors, as they are committed.
#include <gtest/gtest.h>

#include "tests/tools/support/program.hpp"

namespace articular::keys_test {

const std::string kTree = ARTICULAR_SOURCE_DIR;

ProgramResult keys(const std::string& arguments) {
  const TemporaryFolder folder;
  return run_program(folder, "keys " + arguments);
}

struct Committed {
  const char *name, *arguments, *file;
};

class CommittedKeys : public ::testing::TestWithParam<Committed> {};

TEST_P(CommittedKeys, AreWhatTheProgramPrints) {
  const auto& [name, arguments, file] = GetParam();
  const ProgramResult result = keys(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(result.out == content(kTree + "/scenarios/" + file))
      << "make it anew: articular keys " << arguments << " > scenarios/" << file;
}

INSTANTIATE_TEST_SUITE_P(
    Keys, CommittedKeys,
    ::testing::Values(Committed{"Reference", "--markdown", "KEYS.md"},
                      Committed{"Schema", "--json-schema", "scenario.schema.json"},
                      Committed{"StudySchema", "--json-schema study", "study.schema.json"},
                      Committed{"FitSchema", "--json-schema fit", "fit.schema.json"},
                      Committed{"TrackSchema", "--json-schema track", "track.schema.json"}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(Keys, OfAKeyWhoseValueIsATableAreShownWithIt) {
  const std::string out = keys("body.material").out;
  EXPECT_NE(out.find("\n  young_modulus\n"), std::string::npos) << out;
  EXPECT_EQ(keys("body.material.element").out.find("young_modulus"), std::string::npos);
}

/// What the schema says of files, which are shell patterns.
ProgramResult validate(const TemporaryFolder& folder, const std::string& schema,
                       const std::string& files) {
  return run_shell(folder, "export LC_ALL=C.UTF-8; python3 " + kTree +
                               "/tests/tools/keys/validate_files.py " + kTree + "/scenarios/" +
                               schema + " " + files);
}

TEST(Schema, TakesAllShippedFiles) {
  const TemporaryFolder folder;
  const std::string all = kTree + "/scenarios";
  const ProgramResult scenarios =
      validate(folder, "scenario.schema.json",
               "$(find " + all + " -name '*.toml' | xargs grep -L '^scenario *=' )");
  EXPECT_EQ(scenarios.exit_code, 0) << scenarios.out << scenarios.err;
  const ProgramResult studies = validate(folder, "study.schema.json",
                                         "$(grep -L 'parameter\\|target' $(find " + all +
                                             " -name '*.toml' | xargs grep -l '^scenario *='))");
  EXPECT_EQ(studies.exit_code, 0) << studies.out << studies.err;
  const ProgramResult fits = validate(folder, "fit.schema.json", all + "/knee/*-fit.toml");
  EXPECT_EQ(fits.exit_code, 0) << fits.out << fits.err;
  const ProgramResult tracks =
      validate(folder, "track.schema.json", all + "/mandible/*-track.toml");
  EXPECT_EQ(tracks.exit_code, 0) << tracks.out << tracks.err;
}

TEST(Schema, RefusesWhatTheTablesRefuse) {
  const TemporaryFolder folder;
  folder.file("scene.toml", R"(
duration = 5
titel = "x"
[output]
length_unit = "inch"
[integrator]
max_iterations = 0
step = "15"
[[body]]
name = "disc"
kind = "tissue"
material = { law = "linear", young_modulus = "1 kPa", poisson_ratio = 0.5 }
[[load]]
kind = "gravity"
acceleration = [0, 0, -9.81]
)");
  const ProgramResult result = validate(folder, "scenario.schema.json", "scene.toml");
  EXPECT_EQ(result.exit_code, 1) << result.err;
  for (const char* place :
       {"duration: 5", "'titel' was unexpected", "output.length_unit: 'inch'",
        "integrator.max_iterations: 0", "integrator.step: '15'", "body.0.material: ", "load.0: "})
    EXPECT_NE(result.out.find(place), std::string::npos) << place << "\n" << result.out;
}

TEST(Keys, TellOfATableAKeyAndAPath) {
  const std::string table = keys("layer").out;
  for (const char* words :
       {"layer\n", "  thickness\n", "length, with a unit such as mm, > 0; required",
        "between -1 and 0.5 (exclusive)"})
    EXPECT_NE(table.find(words), std::string::npos) << words << "\n" << table;
  const std::string path = keys("body.hold.at").out;
  EXPECT_TRUE(path.starts_with("hold\n  at\n")) << path;
  EXPECT_EQ(keys("hold.at").out, path);
  const std::string key = keys("young_modulus").out;
  EXPECT_NE(key.find("material\n"), std::string::npos);
  EXPECT_NE(key.find("layer\n"), std::string::npos);
  EXPECT_EQ(key.find("poisson_ratio"), std::string::npos);
  const std::string law = keys("material.law").out;
  EXPECT_NE(law.find("holmes-mow: cartilage without its fluid"), std::string::npos) << law;
}

TEST(Keys, ListAllTablesInShort) {
  const ProgramResult result = keys("");
  EXPECT_EQ(result.exit_code, 0);
  for (const char* words :
       {"[integrator]\n", "duration*", "[[reference]] of a study\n", "* is required"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words;
}

TEST(Keys, SuggestTheNearestForAnUnknownName) {
  const ProgramResult result = keys("youngs_modulus");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err,
            "articular: no table and no key is called `youngs_modulus`; did you mean "
            "`young_modulus`?\n");
  EXPECT_EQ(keys("body.young_modulus").exit_code, 2);
}

}  // namespace articular::keys_test
