// Scenarios with bodies at several fidelities: each word runs, and the default is the tissue.
#include <gtest/gtest.h>

#include <string>

#include "tests/scenarios/scenario_results.hpp"

namespace articular::choices_test {

// Half a millimetre of opening, to see that discs of any kind carry the condyles, or bone does.
TEST(JawChoices, AJawOpensOnTissueOnRigidDiscsAndOnBone) {
  for (const auto& [word, unknowns] :
       {std::pair("tissue", 4452), std::pair("rigid", 18), std::pair("none", 6)}) {
    const ScenarioResults results =
        run_scenario("mandible/opening.toml", {std::string("choice.disc=") + word, "accuracy=fast",
                                               "duration=110 ms", "integrator.step=5 ms"});
    EXPECT_EQ(results.summary().at("outcome"), "finished") << word;
    EXPECT_EQ(results.summary().at("settings").at("choice").at("disc"), word);
    EXPECT_EQ(results.summary().at("size").at("unknown_velocities"), unknowns) << word;
    EXPECT_GT(results.count("reported_pairs"), 0) << word;
    const auto incisor = results.column("incisor.position.z [mm]");
    EXPECT_LT(incisor.back(), incisor.front() - 0.5) << word;
    EXPECT_EQ(results.summary().at("evaluations").at("elastic_force") == 0,
              std::string(word) != "tissue");
  }
}

}  // namespace articular::choices_test
