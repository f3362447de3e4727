// Scenarios with bodies at several fidelities: each word runs, and the default is the tissue.
#include <gtest/gtest.h>

#include <string>

#include "tests/scenarios/scenario_results.hpp"

namespace articular::choices_test {

// Half a millimetre of opening, to see that rigid discs carry the condyles, or bone does. On discs
// of tissue JawOpening sees the jaw open; here they hold it up.
TEST(JawChoices, AJawOpensOnTissueOnRigidDiscsAndOnBone) {
  struct Choice {
    const char* word;
    int unknowns;
    std::string duration;
    double least_opening;  // [mm]
  };
  for (const auto& [word, unknowns, duration, least_opening] :
       {Choice{"tissue", 4452, "30 ms", -0.4}, Choice{"rigid", 18, "110 ms", 0.5},
        Choice{"none", 6, "110 ms", 0.5}}) {
    const ScenarioResults results =
        run_scenario("mandible/opening.toml", {std::string("choice.disc=") + word, "accuracy=fast",
                                               "duration=" + duration, "integrator.step=5 ms"});
    EXPECT_EQ(results.summary().at("outcome"), "finished") << word;
    EXPECT_EQ(results.summary().at("settings").at("choice").at("disc"), word);
    EXPECT_EQ(results.summary().at("size").at("unknown_velocities"), unknowns) << word;
    EXPECT_GT(results.count("reported_pairs"), 0) << word;
    const auto incisor = results.column("incisor.position.z [mm]");
    EXPECT_LT(incisor.back(), incisor.front() - least_opening) << word;
    EXPECT_EQ(results.summary().at("evaluations").at("elastic_force") == 0,
              std::string(word) != "tissue");
  }
}

}  // namespace articular::choices_test
