// Static problems that have no solution, or more than one.
#include <cmath>

#include "tests/benchmarks/extremes/judge.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {
namespace {

/// Refused as it must be: a support is missing, and the body is named.
Finding named(const ProgramRun& run, const std::string& body) {
  const auto end = ended_early(run);
  if (!end) return {Outcome::Failed, "it went on without a support"};
  if (end->outcome != Outcome::Refused) return *end;
  const bool told = run.message.find("`" + body + "`") != std::string::npos &&
                    run.message.find("support") != std::string::npos;
  return {told ? Outcome::Refused : Outcome::Failed, run.message};
}

std::string block() { return box("block", "tissue", {}, solid(1000, "neo-hookean", 1e4, 0.3)); }

Finding falling_tissue(const Bench& bench) {
  return named(bench.run("falls", statics(1, 1) + block() + gravity(9.81), 60), "block");
}

Finding falling_bone(const Bench& bench) {
  const std::string scene = statics(1, 1) + box("bone", "rigid", {}, density(2000)) + gravity(9.81);
  return named(bench.run("falls", scene, 60), "bone");
}

/// On a smooth slope, held back by a thread: it leaves the slope before the thread balances it.
Finding plate_on_a_slope(const Bench& bench) {
  const std::string scene =
      statics(1, 1) + carrier("frame") +
      box("slope", "tissue",
          {.size = {0.06, 0.02, 0.004}, .cells = {12, 4, 1}, .center = {0, 0, -0.002}},
          solid(1000, "neo-hookean", 2e4, 0.3, ", element = \"smoothed\"")) +
      attach("slope", "frame", {-1, -1, -1}, {1, 1, -0.00399}) +
      box("plate", "rigid", {.size = {0.01, 0.01, 0.002}, .center = {-0.02, 0, 0.001}},
          density(2000)) +
      "[[ligament]]\nname = \"thread\"\nstiffness = \"0.001 N/m\"\npath = [{ body = \"frame\", "
      "point = "
      "\"-60 0 1 mm\" }, { body = \"plate\", point = \"-25 0 1 mm\" }]\n"
      "[[load]]\nkind = \"gravity\"\nacceleration = \"3 0 -9.3 m/s^2\"\n";
  const ProgramRun run = bench.run("slides", scene, 60);
  const auto end = ended_early(run);
  if (!end) return {Outcome::Failed, "it went on without a support"};
  if (end->outcome == Outcome::Refused && run.message.find("`plate`") == std::string::npos)
    return {Outcome::Failed, run.message};
  return *end;
}

/// Held in one point only, in a ligament: it turns about it, and finds the way to hang.
Finding hanging_bone(const Bench& bench) {
  const std::string scene =
      statics(1, 1) + carrier("ceiling") + box("bone", "rigid", {}, density(2000)) + gravity(9.81) +
      "[[ligament]]\nname = \"band\"\nstiffness = \"100 N/m\"\npath = [{ body "
      "= \"ceiling\", point = \"5 5 30 mm\" }, { body = \"bone\", point = \"5 "
      "5 5 mm\" }]\n" +
      "[[probe]]\nname = \"band\"\nkind = \"line\"\nline = \"band\"\n";
  const ProgramRun run = bench.run("hangs", scene, 60);
  if (const auto end = ended_early(run)) return *end;
  const double weight = 2000 * 1e-6 * 9.81;
  return judged(run, std::abs(ScenarioResults(run.results).last("band.force [N]") / weight - 1),
                {.right = 1e-4, .stable = 0.1}, "force of the ligament against the weight");
}

}  // namespace

std::vector<Extreme> missing_supports() {
  return {{.name = "static, a support is missing",
           .range = "tissue under gravity",
           .expected = Outcome::Refused,
           .quick = true,
           .study = falling_tissue},
          {.name = "static, a support is missing",
           .range = "rigid body under gravity",
           .expected = Outcome::Refused,
           .quick = true,
           .study = falling_bone},
          {.name = "static, a support is missing",
           .range = "rigid plate on a smooth slope",
           .expected = Outcome::Refused,
           .quick = true,
           .study = plate_on_a_slope},
          {.name = "static, a support is missing",
           .range = "body on one ligament at its corner",
           .quick = true,
           .study = hanging_bone}};
}

}  // namespace articular::benchmarks
