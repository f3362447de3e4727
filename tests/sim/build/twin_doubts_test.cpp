// What a scenario says twice.
#include "sim/build/twin_doubts.hpp"

#include <gtest/gtest.h>

#include "sim/build/build_model.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::twin_doubts_test {

std::vector<std::string> doubts_of(const std::string& entries) {
  const TemporaryFolder folder;
  return build_model(read_scenario(folder.file("twins.toml", R"(duration = "1 s"
contact = false
[[body]]
name = "bar"
kind = "tissue"
density = "1 g/cm^3"
material = { law = "neo-hookean", young_modulus = "10 kPa", poisson_ratio = 0.4 }
geometry = { box = { size = "20 4 4 mm", cells = [4, 1, 1] } }
[[body]]
name = "wall"
kind = "fixed"
[[attach]]
body = "bar"
to = "wall"
region = { box = ["-11 -3 -3 mm", "-9.99 3 3 mm"] }
)" + entries)))
      .warnings;
}

/// Both entries alone, and one after the other, are as they should be; twice the first is told.
void expect_twins(const std::string& entry, const std::string& other, const std::string& words) {
  EXPECT_TRUE(doubts_of(entry + other).empty()) << entry;
  const std::vector<std::string> doubts = doubts_of(entry + entry);
  ASSERT_EQ(doubts.size(), 1U) << entry;
  EXPECT_NE(doubts[0].find(words), std::string::npos) << doubts[0];
}

TEST(TwinDoubts, AreOfGravityThatActsTwice) {
  const auto gravity = [](const std::string& g) {
    return "[[load]]\nkind = \"gravity\"\nacceleration = \"0 0 " + g + " m/s^2\"\n";
  };
  expect_twins(gravity("-9.81"), gravity("-1"),
               "twins.toml:19:1: the same gravity is there already, at ");
}

TEST(TwinDoubts, AreOfOneLoadTwiceOnTheSameFaces) {
  const auto pressure = [](const std::string& value) {
    return "[[load]]\nkind = \"pressure\"\nbody = \"bar\"\nregion = { box = [\"-11 -3 1.99 "
           "mm\", \"11 3 2.01 mm\"] }\npressure = \"" +
           value + "\"\n";
  };
  expect_twins(pressure("100 Pa"), pressure("200 Pa"),
               "the same load on the same faces of `bar` is there already, at ");
}

TEST(TwinDoubts, AreOfLinesFromTheSamePointsToTheSamePoints) {
  const auto line = [](const std::string& kind, const std::string& name, const std::string& z,
                       const std::string& more) {
    const std::string from = R"({ body = "wall", point = "-20 0 0 mm" })",
                      to = R"({ body = "bar", radius = "3 mm", point = "0 0 )" + z + " mm\" }";
    const bool turned = name == "turned";
    return "[[" + kind + "]]\nname = \"" + name + "\"\n" + more + "path = [" +
           (turned ? to : from) + ", " + (turned ? from : to) + "]\n";
  };
  const std::string spring = "stiffness = \"1 N/mm\"\n", pull = "max_force = \"2 N\"\n";
  for (const auto& [kind, more] : {std::pair("ligament", spring), std::pair("muscle", pull)}) {
    const std::string driven = std::string(kind) == "muscle"
                                   ? more + "excitation = { time = [\"0 s\"], value = [1] }\n"
                                   : more;
    EXPECT_TRUE(doubts_of(line(kind, "a", "0", driven) + line(kind, "b", "1", driven)).empty());
    for (const std::string twin : {"b", "turned"}) {
      const std::vector<std::string> doubts =
          doubts_of(line(kind, "a", "0", driven) + line(kind, twin, "0", driven));
      ASSERT_EQ(doubts.size(), 1U) << kind;
      EXPECT_NE(doubts[0].find(std::string(kind) + " `" + twin + "` is the same as `a`, at "),
                std::string::npos)
          << doubts[0];
    }
  }
}

TEST(TwinDoubts, AreOfSheetsOnTheSameFacesWithTheSameFibres) {
  const auto sheet = [](const std::string& name, const std::string& along, const std::string& x) {
    return "[[sheet]]\nname = \"" + name +
           "\"\nbody = \"bar\"\nregion = { box = [\"-11 -3 1.99 mm\", \"" + x +
           " 3 2.01 mm\"] }\nthickness = \"0.2 mm\"\nyoung_modulus = \"10 MPa\"\nfibres = { "
           "direction = " +
           along + " }\n";
  };
  const std::string a = sheet("a", "[1, 0, 0]", "11");
  EXPECT_TRUE(doubts_of(a + sheet("b", "[0, 1, 0]", "11")).empty());
  for (const std::string& other : doubts_of(a + sheet("b", "[1, 0, 0]", "1")))
    ADD_FAILURE() << other;
  const std::vector<std::string> doubts = doubts_of(a + sheet("b", "[-2, 0, 0]", "11"));
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_NE(doubts[0].find("sheet `b` lies on the same faces as `a`, at "), std::string::npos)
      << doubts[0];
}

}  // namespace articular::sim::twin_doubts_test
