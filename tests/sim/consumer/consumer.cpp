#include <iostream>
#include <sim/run/run.hpp>
#include <sim/scenario/scenario.hpp>

#include "sim/build/build_model.hpp"
using namespace articular::sim;

int main(int, char** argv) {  // consumer SCENARIO FOLDER
  const Scenario scenario = read_scenario(argv[1], {});
  const Model model = build_model(scenario);
  RunOptions options{.directory = argv[2]};
  options.after_step = [](const State& state, double duration) {
    std::cout << state.t << " of " << duration << " s\n";
    return false;
  };
  return run(scenario, model, options) == RunOutcome::Finished ? 0 : 1;
}
