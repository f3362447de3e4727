// The scenarios of scenarios/mandible/ are one jaw: what its tissues are made of does not depend on
// what it does. A scenario has no way to take constants from another file, so they are compared
// here.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/sim/support/temporary_folder.hpp"

namespace articular::jaw_constants_test {

/// A table of a file, such as "[[body]]", without comments.
struct Block {
  std::string table, name;
  std::vector<std::string> lines;
};

std::vector<Block> blocks(const std::filesystem::path& file) {
  std::vector<Block> found;
  std::istringstream text(content(file));
  for (std::string line; std::getline(text, line);) {
    line = line.substr(0, line.find('#'));
    line.erase(line.find_last_not_of(' ') + 1);
    if (line.starts_with("["))
      found.push_back({line, "", {}});
    else if (!line.empty() && !found.empty())
      found.back().lines.push_back(line);
    std::smatch match;
    if (std::regex_match(line, match, std::regex(R"re(name = "(.*)")re")))
      found.back().name = match[1];
  }
  return found;
}

/// What all scenarios of the jaw, but those that are left out, say of this key where `wanted`
/// holds.
template <class Wanted>
std::set<std::string> values(const std::string& key, const std::set<std::string>& leave_out,
                             const Wanted& wanted) {
  std::set<std::string> found;
  for (const auto& entry :
       std::filesystem::directory_iterator(ARTICULAR_SOURCE_DIR "/scenarios/mandible")) {
    if (entry.path().extension() != ".toml" || leave_out.contains(entry.path().filename()))
      continue;
    for (const Block& block : blocks(entry.path()))
      if (wanted(block))
        for (const std::string& line : block.lines)
          if (line.starts_with(key + " =")) found.insert(line);
  }
  return found;
}

bool is_disc(const Block& block) {
  return block.table == "[[body]]" && block.name.starts_with("disc_");
}

TEST(JawConstants, DiscsAreOfOneMaterialInAllScenarios) {
  const std::string ground = R"(c10 = "0.9 MPa", bulk_modulus = "90 MPa", )";
  EXPECT_EQ(
      values("material", {"subject.toml"}, is_disc),
      std::set<std::string>{R"(material = { law = "transversely-isotropic", )" + ground +
                            R"(c3 = "0.196 MPa", c4 = 50, toe_end = 1.03, c5 = "44 MPa", )" +
                            R"(fibres = { array = "fibres" }, stiffness_damping = "5 ms" })"});
  // Nobody recorded the fibres of that jaw's discs.
  EXPECT_TRUE(values("material", {}, is_disc)
                  .contains(R"(material = { law = "mooney-rivlin", )" + ground +
                            R"(stiffness_damping = "5 ms" })"));
  EXPECT_EQ(values("layer", {}, is_disc).size(), 1U);  // of those that are rigid
}

TEST(JawConstants, TeethHavePeriodontalLigamentsInAllScenarios) {
  const std::set<std::string> teeth = {"upper_teeth", "upper_molars", "bar"};
  EXPECT_EQ(
      values("layer", {}, [&](const Block& block) { return teeth.contains(block.name); }),
      std::set<std::string>{
          R"(layer = { thickness = "0.4 mm", young_modulus = "1.2 MPa", poisson_ratio = 0.45 })"});
}

TEST(JawConstants, BonesMusclesAndLigamentsAreTheSame) {
  const auto mandible = [](const Block& block) { return block.name == "mandible"; };
  for (const char* key : {"layer", "mass", "center_of_mass", "inertia"})
    EXPECT_EQ(values(key, {"subject.toml"}, mandible).size(), 1U) << key;  // another jaw
  const auto muscles = [](const Block& block) { return block.table == "[[muscle_table]]"; };
  for (const char* key : {"max_velocity", "activation_time", "deactivation_time"})
    EXPECT_EQ(values(key, {}, muscles).size(), 1U) << key;
  for (const char* name :
       {"sphenomandibular", "stylomandibular", "temporomandibular_oblique",
        "temporomandibular_level", "capsule_lateral", "capsule_medial", "capsule_posterior",
        "disc_lateral_front", "disc_lateral_back", "disc_medial_front", "disc_medial_back",
        "disc_anterior", "disc_posterior_inferior", "retrodiscal_lateral", "retrodiscal_medial"})
    for (const char* key : {"stiffness", "damping", "slack_extension"})
      EXPECT_EQ(values(key, {"subject.toml"},
                       [&](const Block& block) {
                         return block.table == "[[ligament]]" && block.name == name;
                       })
                    .size(),
                1U)
          << name << ", " << key;
}

}  // namespace articular::jaw_constants_test
