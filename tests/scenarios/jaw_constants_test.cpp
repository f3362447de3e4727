// The scenarios of scenarios/mandible/ are one jaw: what its tissues are made of does not depend on
// what it does. A scenario has no way to take constants from another file, so they are compared
// here.
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <string>

namespace articular::jaw_constants_test {

using Names = std::set<std::string>;

std::string text_of(const toml::node& node) {
  std::ostringstream text;
  text << toml::json_formatter(node);
  return text.str();
}

/// As all values are told apart: any order of keys and any spaces.
std::string value(const std::string& given) {
  return text_of(*toml::parse("given = " + given).get("given"));
}

/// What all scenarios of the jaw, but those that are left out, say of a key of these entries. None
/// are named: of all.
Names values(const std::string& entries, const Names& names, const std::string& key,
             const Names& leave_out = {}) {
  Names found;
  for (const auto& file :
       std::filesystem::directory_iterator(ARTICULAR_SOURCE_DIR "/scenarios/mandible")) {
    if (file.path().extension() != ".toml" || leave_out.contains(file.path().filename())) continue;
    toml::table document = toml::parse_file(file.path().string());
    if (const toml::array* list = document[entries].as_array())
      for (const toml::node& entry : *list) {
        const toml::table& table = *entry.as_table();
        if (!names.empty() && !names.contains(table["name"].value_or(std::string()))) continue;
        if (const toml::node* node = table.get(key)) found.insert(text_of(*node));
      }
  }
  return found;
}

const Names kDiscs = {"disc_left", "disc_right"};

TEST(JawConstants, DiscsAreOfOneMaterialInAllScenarios) {
  const std::string ground =
      R"(c10 = "0.9 MPa", bulk_modulus = "90 MPa", stiffness_damping = "5 ms", )";
  EXPECT_EQ(values("body", kDiscs, "material", {"subject.toml"}),
            Names{value(R"({ law = "transversely-isotropic", )" + ground +
                        R"(c3 = "0.196 MPa", c4 = 50, toe_end = 1.03, c5 = "44 MPa", )" +
                        R"(fibres = { array = "fibres" } })")});
  // Nobody recorded the fibres of that jaw's discs.
  EXPECT_TRUE(values("body", kDiscs, "material")
                  .contains(value("{ " + ground + R"(law = "mooney-rivlin" })")));
  EXPECT_EQ(values("body", kDiscs, "layer").size(), 1U);  // of those that are rigid
}

TEST(JawConstants, TeethHavePeriodontalLigamentsInAllScenarios) {
  EXPECT_EQ(
      values("body", {"upper_teeth", "upper_molars", "bar"}, "layer"),
      Names{value(R"({ thickness = "0.4 mm", young_modulus = "1.2 MPa", poisson_ratio = 0.45, )"
                  R"(law = "logarithmic" })")});
}

TEST(JawConstants, BonesMusclesAndLigamentsAreTheSame) {
  for (const char* key : {"layer", "mass", "center_of_mass", "inertia"})
    EXPECT_EQ(values("body", {"mandible"}, key, {"subject.toml"}).size(), 1U)
        << key;  // another jaw
  for (const char* key : {"max_velocity", "activation_time", "deactivation_time"})
    EXPECT_EQ(values("muscle_table", {}, key).size(), 1U) << key;
  for (const char* name :
       {"sphenomandibular", "stylomandibular", "temporomandibular_oblique",
        "temporomandibular_level", "capsule_lateral", "capsule_medial", "capsule_posterior",
        "disc_lateral_front", "disc_lateral_back", "disc_medial_front", "disc_medial_back",
        "disc_anterior", "disc_posterior_inferior", "retrodiscal_lateral", "retrodiscal_medial"})
    for (const char* key : {"stiffness", "damping", "slack_extension"})
      EXPECT_EQ(values("ligament", {name}, key, {"subject.toml"}).size(), 1U)
          << name << ", " << key;
}

}  // namespace articular::jaw_constants_test
