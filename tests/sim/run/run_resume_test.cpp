// run(): interruption, checkpoints, and what a resumed run makes of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "sim/build/build_model.hpp"
#include "sim/output/checkpoint.hpp"
#include "sim/output/output_size.hpp"
#include "tests/sim/support/run_scene.hpp"

namespace articular::sim::run_resume_test {

/// The files below a folder, but for the summary, which holds wall times.
std::map<std::string, std::string> files(const fs::path& folder) {
  std::map<std::string, std::string> result;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().filename() != "summary.json")
      result[fs::relative(entry.path(), folder).string()] = content(entry.path());
  return result;
}

void expect_same_files(const fs::path& a, const fs::path& b) {
  const auto expected = files(a), found = files(b);
  EXPECT_GT(expected.size(), 30U);
  ASSERT_EQ(expected.size(), found.size());
  for (const auto& [name, bytes] : expected) {
    ASSERT_TRUE(found.count(name)) << name;
    EXPECT_TRUE(found.at(name) == bytes) << name << " differs";
  }
}

/// Tissue that is out of balance at the start.
const std::string kPrestretched =
    "body.block.material={ law = \"transversely-isotropic\", c10 = \"4 kPa\", c3 = \"2 kPa\", "
    "c4 = 10, c5 = \"100 kPa\", toe_end = 1.2, prestretch = 1.1, bulk_modulus = \"40 kPa\", "
    "fibres = { direction = [1, 0, 1] } }";

class Resumed : public RunTest, public ::testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(Run, Resumed,
                         ::testing::Values("integrator.scheme=implicit-euler",
                                           "integrator.scheme=tr-bdf2",
                                           "integrator.solver=conjugate-gradients", kPrestretched));

// Interrupted between two checkpoints, twice; every byte of checkpoint, history and frames.
TEST_P(Resumed, AnInterruptedRunGivesTheSameFilesBitForBit) {
  const std::vector<std::string> overrides = {GetParam()};
  EXPECT_EQ(run_all("whole", false, overrides), RunOutcome::Finished);
  EXPECT_EQ(run_until(0.0275, "parts", false, overrides), RunOutcome::Interrupted);
  EXPECT_EQ(run_until(0.043, "parts", true, overrides), RunOutcome::Interrupted);
  EXPECT_EQ(run_all("parts", true, overrides), RunOutcome::Finished);
  expect_same_files(out("whole"), out("parts"));
}

/// A block bounces off another: contact couplings come and go. All times are multiples of 2^-14 s,
/// so that every step has the same length to the last bit, and a matrix that was factored before a
/// checkpoint would serve after it.
const std::string kBouncing = R"(
duration = "62.5 ms"
[integrator]
step = "0.9765625 ms"
[[body]]
name = "table"
kind = "fixed"
geometry = { box = { size = "20 20 4 mm", cells = [2, 2, 1], center = "0 0 -2 mm" } }
[[body]]
name = "block"
kind = "tissue"
geometry = { box = { size = "10 10 10 mm", cells = [3, 3, 3], center = "0 0 5 mm" } }
density = "1000 kg/m^3"
material = { law = "neo-hookean", young_modulus = "10 kPa", poisson_ratio = 0.4, element = "plain" }
[[attach]]
body = "block"
to = "table"
region = { box = ["-6 -6 -0.1 mm", "6 6 0.1 mm"] }
[[body]]
name = "bouncer"
kind = "tissue"
geometry = { box = { size = "6 5 4 mm", cells = [3, 2, 2] }, place = { rotation = "4 6 20 deg", translation = "0.5 0 12.8 mm" } }
density = "1000 kg/m^3"
material = { law = "neo-hookean", young_modulus = "10 kPa", poisson_ratio = 0.4, element = "plain" }
velocity = "80 0 -250 mm/s"
[[probe]]
name = "energy"
kind = "energy"
[[probe]]
name = "contact"
kind = "contact"
bodies = ["block", "bouncer"]
[output]
interval = "7.8125 ms"
checkpoint_interval = "7.8125 ms"
)";

/// Rigid cubes fall onto a floor and onto each other: pairs become near and part again.
std::string heap_of_cubes() {
  std::string text = R"(
duration = "24 ms"
[integrator]
step = "1 ms"
[output]
interval = "8 ms"
checkpoint_interval = "8 ms"
[[body]]
name = "floor"
kind = "fixed"
geometry = { box = { size = "60 60 4 mm", cells = [4, 4, 1], center = "0 0 -2 mm" } }
[[contact]]
bodies = ["cube *", "*"]
friction = 0.3
[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"
[[probe]]
name = "energy"
kind = "energy"
)";
  for (int i = 0; i < 8; ++i) {
    const int layer = i / 4;
    text += "[[body]]\nname = \"cube " + std::to_string(i) +
            "\"\nkind = \"rigid\"\ndensity = \"1 g/cm^3\"\nvelocity = \"0 0 " +
            std::to_string(layer == 0 ? -200 : -300) +
            " mm/s\"\ngeometry = { box = { size = \"5 5 5 mm\", cells = [1, 1, 1], center = \"" +
            std::to_string(i % 2 * 5.3 + i * 0.03) + " " + std::to_string(i / 2 % 2 * 5.2) + " " +
            std::to_string(2.6 + layer * 5.2) + " mm\" } }\n";
  }
  return text;
}

TEST_F(RunTest, AHeapThatWasInterruptedIsTheUninterruptedOneOnAnyNumberOfThreads) {
  Scenario heap = read_scenario(folder_.file("heap.toml", heap_of_cubes()));
  const auto run_to = [&](double until, const std::string& name, bool resume) {
    const Model model = build_model(heap);
    RunOptions options;
    options.directory = out(name);
    options.resume = resume;
    options.after_step = [until](const State& state, double) { return state.t >= until; };
    run(heap, model, options);
  };
  run_to(1, "whole", false);
  const std::string whole = content(out("whole") / "history.csv");
  EXPECT_GT(nlohmann::json::parse(content(out("whole") / "summary.json"))
                .at("counts")
                .at("reported_pairs")
                .get<int>(),
            100);
  heap.threads = 2;
  for (const double until : {0.0105, 0.0185}) {
    const std::string name = "parts" + std::to_string(until);
    run_to(until, name, false);
    run_to(1, name, true);
    EXPECT_EQ(content(out(name) / "history.csv"), whole);
    EXPECT_TRUE(content(out(name) / "checkpoint/state.bin") ==
                content(out("whole") / "checkpoint/state.bin"));
  }
}

/// A jaw is thrown against food on both sides, and pushed against it again.
const std::string kJawOnFood = R"(
duration = "60 ms"
contact = false
[integrator]
step = "0.5 ms"
[[body]]
name = "skull"
kind = "fixed"
geometry = { box = { size = "60 20 4 mm", cells = [1, 1, 1] } }
[[body]]
name = "jaw"
kind = "rigid"
density = "20 g/cm^3"
velocity = "0 0 500 mm/s"
geometry = { box = { size = "60 20 4 mm", cells = [1, 1, 1], center = "0 0 -20 mm" } }
[[bolus]]
name = "nut"
mirror = "x"
path = [{ body = "skull", point = "20 0 -2 mm" }, { body = "jaw", point = "20 0 -18 mm" }]
depth = ["0 mm", "0.5 mm", "1 mm", "3 mm"]
force = ["0 N", "20 N", "12 N", "60 N"]
unloading_stiffness = "200 N/mm"
force_kept = 0.7
[[load]]
kind = "force"
body = "jaw"
point = "0 0 -20 mm"
force = "0 0 20 N"
profile = { time = ["20 ms", "21 ms"], value = [0, 1] }
[[probe]]
name = "nut"
kind = "line"
mirror = "x"
line = "nut_left"
[[probe]]
name = "jaw"
kind = "point"
body = "jaw"
point = "0 0 -20 mm"
[[probe]]
name = "energy"
kind = "energy"
[output]
interval = "0.5 ms"
checkpoint_interval = "5 ms"
)";

TEST_F(RunTest, FoodOnBothSidesStaysCrushedInAResumedRunAndPushesAlike) {
  const Scenario scenario = read_scenario(folder_.file("food.toml", kJawOnFood));
  const auto run_to = [&](double until, const std::string& name, bool resume) {
    const Model model = build_model(scenario);
    RunOptions options;
    options.directory = out(name);
    options.resume = resume;
    options.after_step = [&](const State& state, double) {
      EXPECT_EQ(state.boluses[0].deepest, state.boluses[1].deepest);
      EXPECT_LT(state.boluses[0].strength, state.t < 0.05 ? 1.1 : 0.9);
      return state.t >= until;
    };
    run(scenario, model, options);
  };
  run_to(1, "whole", false);
  for (const double until : {0.0125, 0.0335}) {
    const std::string name = "parts" + std::to_string(until);
    run_to(until, name, false);
    run_to(1, name, true);
    EXPECT_EQ(content(out(name) / "history.csv"), content(out("whole") / "history.csv"));
    EXPECT_TRUE(content(out(name) / "checkpoint/state.bin") ==
                content(out("whole") / "checkpoint/state.bin"));
  }
}

constexpr double kBetweenCheckpoints = 0.0078125;

// A step at a checkpoint must not know what was before it: a matrix, a pattern that has grown.
TEST_F(RunTest, ARunResumedWhileContactsComeAndGoIsTheUninterruptedOne) {
  const Scenario bouncing = read_scenario(folder_.file("bouncing.toml", kBouncing));
  const Model model = build_model(bouncing);
  const auto run_to = [&](double until, const std::string& name, bool resume) {
    RunOptions options;
    options.directory = out(name);
    options.resume = resume;
    options.after_step = [until](const State& state, double) { return state.t >= until; };
    run(bouncing, model, options);
  };
  run_to(1, "whole", false);
  const std::string whole = content(out("whole") / "history.csv");
  // It touches before and after the first checkpoint, and no more after the fourth.
  const auto lines = split(whole, '\n');
  const auto columns = split(lines[0], ',');
  const auto area = static_cast<std::size_t>(
      std::find(columns.begin(), columns.end(), "contact.area [mm^2]") - columns.begin());
  const auto touches = [&](double from, double to) {
    return std::any_of(lines.begin() + 1, lines.end(), [&](const std::string& line) {
      const auto cells = split(line, ',');
      const double t = std::stod(cells[0]);
      return t > from && t <= to && std::stod(cells[area]) > 0;
    });
  };
  EXPECT_TRUE(touches(0, kBetweenCheckpoints));
  EXPECT_TRUE(touches(kBetweenCheckpoints, 2 * kBetweenCheckpoints));
  EXPECT_FALSE(touches(4 * kBetweenCheckpoints, 1));
  for (int checkpoint = 1; checkpoint < 8; ++checkpoint) {
    const std::string name = "parts" + std::to_string(checkpoint);
    run_to((checkpoint + 0.3) * kBetweenCheckpoints, name, false);
    run_to(1, name, true);
    EXPECT_EQ(content(out(name) / "history.csv"), whole) << checkpoint;
    // In full precision.
    EXPECT_TRUE(content(out(name) / "checkpoint/state.bin") ==
                content(out("whole") / "checkpoint/state.bin"))
        << checkpoint;
  }
}

/// In equilibrium; a plate comes down on a block by 1 mm in four load steps.
const std::string kPressed = R"(
duration = "0.4 s"
analysis = "static"
[integrator]
step = "0.1 s"
[[body]]
name = "floor"
kind = "fixed"
[[body]]
name = "plate"
kind = "fixed"
geometry = { box = { size = "20 20 2 mm", cells = [4, 4, 1], center = "0 0 11 mm" } }
[[body]]
name = "block"
kind = "tissue"
geometry = { box = { size = "10 10 10 mm", cells = [4, 4, 4], center = "0 0 5 mm" } }
density = "1000 kg/m^3"
material = { law = "neo-hookean", young_modulus = "15 kPa", poisson_ratio = 0.45, element = "smoothed" }
[[attach]]
body = "block"
to = "floor"
region = { box = ["-6 -6 -0.1 mm", "6 6 0.1 mm"] }
[[load]]
kind = "motion"
body = "plate"
time = ["0 s", "0.4 s"]
translation = ["0 0 0 mm", "0 0 -1 mm"]
[[probe]]
name = "plate"
kind = "contact"
bodies = ["plate", "block"]
[[probe]]
name = "energy"
kind = "energy"
[output]
interval = "0.1 s"
)";

// In equilibrium nothing has a velocity.
TEST_F(RunTest, FramesInEquilibriumHaveNoVelocities) {
  const Scenario pressed = read_scenario(folder_.file("pressed.toml", kPressed));
  const Model model = build_model(pressed);
  RunOptions options;
  options.directory = out("pressed");
  run(pressed, model, options);
  double size = 0;
  for (const auto& frame : fs::directory_iterator(out("pressed") / "frames")) {
    EXPECT_EQ(content(frame.path()).find("velocity"), std::string::npos) << frame.path();
    size += static_cast<double>(fs::file_size(frame.path()));
  }
  EXPECT_NEAR(size, 5 * estimated_output(pressed, model).frame_bytes, 0.1 * size);
}

// In the middle of a load step: what was written is that of the steps before it, energies too, and
// a resumed run goes on to what it would have been.
TEST_F(RunTest, ALoadStepIsInterruptedAfterAnyOfItsIterations) {
  const Scenario pressed = read_scenario(folder_.file("pressed.toml", kPressed));
  const Model model = build_model(pressed);
  int done = 0;
  const auto run_to = [&](double t, int iteration, const std::string& name, bool resume) {
    int of_step = 0;
    double load_step = 0;
    RunOptions options;
    options.directory = out(name);
    options.resume = resume;
    options.after_iteration = [&](double towards, const NewtonIteration& newton) {
      EXPECT_GE(newton.residual, 0);
      if (towards != load_step) of_step = 0;
      load_step = towards;
      ++done;
      return towards > t && ++of_step == iteration;
    };
    return run(pressed, model, options);
  };
  const auto summary = [&](const std::string& name) {
    return nlohmann::json::parse(content(out(name) / "summary.json"));
  };
  EXPECT_EQ(run_to(1, 1, "whole", false), RunOutcome::Finished);
  EXPECT_EQ(done, summary("whole")["counts"]["newton_iterations"]);
  for (const int iteration : {1, 2}) {
    for (const double t : {0.05, 0.15, 0.35}) {
      const std::string name = "parts" + std::to_string(iteration) + std::to_string(t);
      EXPECT_EQ(run_to(t, iteration, name, false), RunOutcome::Interrupted);
      EXPECT_EQ(summary(name)["outcome"], "interrupted");
      const auto rows = split(content(out(name) / "history.csv"), '\n');
      const auto columns = split(rows.front(), ','), last = split(rows.back(), ',');
      EXPECT_NEAR(std::stod(last[0]), summary(name)["simulated_time_s"].get<double>(), 1e-9);
      EXPECT_LT(std::stod(last[0]), t);
      const auto elastic = static_cast<std::size_t>(
          std::find(columns.begin(), columns.end(), "energy.elastic [J]") - columns.begin());
      const double energy = summary(name)["energy"]["end"]["elastic"];
      EXPECT_NEAR(std::stod(last[elastic]), energy, 1e-8 * energy);
      EXPECT_EQ(run_to(1, 1, name, true), RunOutcome::Finished);
      EXPECT_EQ(content(out(name) / "history.csv"), content(out("whole") / "history.csv"));
      EXPECT_EQ(content(out(name) / "convergence.csv"), content(out("whole") / "convergence.csv"));
    }
  }
}

// Between the parts of an iteration too, as one of a large scene takes long.
TEST_F(RunTest, ALoadStepIsInterruptedWhereverItAsks) {
  const Scenario pressed = read_scenario(folder_.file("pressed.toml", kPressed));
  const Model model = build_model(pressed);
  const auto run_to = [&](int last_question, const std::string& name, bool resume) {
    RunOptions options;
    options.directory = out(name);
    options.resume = resume;
    int asked = 0, iterations = 0;
    options.is_to_stop = [&] { return ++asked == last_question; };
    options.after_iteration = [&](double, const NewtonIteration&) { return ++iterations < 0; };
    const RunOutcome outcome = run(pressed, model, options);
    // Forces, assembly, factorization and solution of each.
    EXPECT_GE(asked, 4 * iterations);
    return outcome;
  };
  EXPECT_EQ(run_to(-1, "whole", false), RunOutcome::Finished);
  for (const int question : {1, 2, 3, 4, 5, 31}) {
    const std::string name = "parts" + std::to_string(question);
    EXPECT_EQ(run_to(question, name, false), RunOutcome::Interrupted) << question;
    EXPECT_NE(content(out(name) / "summary.json").find("\"interrupted\""), std::string::npos);
    EXPECT_EQ(run_to(-1, name, true), RunOutcome::Finished);
    EXPECT_EQ(content(out(name) / "history.csv"), content(out("whole") / "history.csv"));
    EXPECT_EQ(content(out(name) / "convergence.csv"), content(out("whole") / "convergence.csv"));
  }
}

// In the middle of a step of time, which may take long too: likewise.
TEST_F(RunTest, AStepIsInterruptedAtAnyOfItsEvaluations) {
  for (const std::string scheme : {"implicit-euler", "tr-bdf2", "explicit"}) {
    const std::string duration = scheme == "explicit" ? "20 ms" : "60 ms";
    const std::vector<std::string> overrides = {"duration='" + duration + "'",
                                                "integrator.scheme='" + scheme + "'"};
    run_all("whole " + scheme, false, overrides);
    const std::string whole = content(out("whole " + scheme) / "history.csv");
    for (const int evaluation : {1, 20, 71}) {
      const std::string name = scheme + std::to_string(evaluation);
      RunOptions options;
      options.directory = out(name);
      int asked = 0;
      options.is_to_stop = [&] { return ++asked == evaluation; };
      EXPECT_EQ(run_with(options, overrides), RunOutcome::Interrupted);
      EXPECT_EQ(asked, evaluation);
      const std::string history = content(out(name) / "history.csv");
      EXPECT_EQ(whole.substr(0, history.size()), history);
      const auto summary = nlohmann::json::parse(content(out(name) / "summary.json"));
      EXPECT_EQ(summary["outcome"], "interrupted");
      EXPECT_NEAR(std::stod(split(split(history, '\n').back(), ',')[0]),
                  summary["simulated_time_s"].get<double>(), 1e-9);
      run_all(name, true, overrides);
      EXPECT_EQ(content(out(name) / "history.csv"), whole);
    }
  }
}

// Settling takes long too; what an earlier run has left in the folder doesn't outlive it.
TEST_F(RunTest, SettlingIsInterruptedAndResumingStartsAfresh) {
  const std::vector<std::string> overlap = {"body.table.geometry.box.center=0 0 -1.1 mm",
                                            "duration=30 ms"};
  run_all("whole", false, overlap);
  run_all("parts", false, overlap);
  RunOptions options;
  options.directory = out("parts");
  options.after_iteration = [](double t, const NewtonIteration&) {
    EXPECT_EQ(t, 0);
    return true;
  };
  EXPECT_EQ(run_with(options, overlap), RunOutcome::Interrupted);
  EXPECT_EQ(split(content(out("parts") / "history.csv"), '\n').size(), 1U);
  EXPECT_FALSE(fs::exists(out("parts") / "scene.pvd"));
  run_all("parts", true, overlap);
  EXPECT_EQ(content(out("parts") / "history.csv"), content(out("whole") / "history.csv"));
}

// Where the table stands 1 mm in the block: the summary tells how they were set apart, also that of
// a resumed run, which goes on from there.
TEST_F(RunTest, SettlingIsToldAndKeptByCheckpoints) {
  const std::vector<std::string> overlap = {"body.table.geometry.box.center=0 0 -1.1 mm",
                                            "duration=30 ms"};
  int calls = 0;
  RunOptions options;
  options.directory = out("whole");
  options.after_overlap_resolution = [&](const OverlapResolution&) { ++calls; };
  run_with(options, overlap);
  const auto resolution = [&](const std::string& name) {
    return nlohmann::json::parse(content(out(name) / "summary.json"))["overlap_resolution"];
  };
  const nlohmann::json whole = resolution("whole");
  EXPECT_EQ(calls, 1);
  ASSERT_EQ(whole["overlaps"].size(), 1U);
  EXPECT_EQ(whole["overlaps"][0]["bodies"], (std::vector<std::string>{"table", "block"}));
  EXPECT_NEAR(whole["overlaps"][0]["before_m"], 0.9e-3, 1e-9);
  EXPECT_LT(whole["overlaps"][0]["after_m"], 0.05e-3);
  EXPECT_NEAR(whole["largest_motion_m"], 0.9e-3, 0.1e-3);
  EXPECT_GE(whole["newton_iterations"], whole["solutions"]);
  const auto times = nlohmann::json::parse(content(out("whole") / "summary.json"))["wall_time_s"];
  EXPECT_GT(times["overlap_resolution"], 0);
  // The overlap that there was is no penetration of the run.
  EXPECT_LT(nlohmann::json::parse(content(out("whole") / "summary.json"))["max_penetration_m"],
            0.2e-3);
  run_until(0.023, "parts", false, overlap);
  run_all("parts", true, overlap);
  EXPECT_EQ(resolution("parts"), whole);
  EXPECT_EQ(content(out("parts") / "history.csv"), content(out("whole") / "history.csv"));
}

// A checkpoint at 2/3 of something: its time has no end in decimals, and is printed rounded up.
TEST_F(RunTest, ACheckpointAtATimeThatIsPrintedRoundedUpKeepsItsRow) {
  const std::vector<std::string> overrides = {"output.checkpoint_interval=6.666666666666667 ms",
                                              "duration=30 ms"};
  run_all("whole", false, overrides);
  run_until(0.0085, "parts", false, overrides);
  run_all("parts", true, overrides);
  EXPECT_EQ(content(out("whole") / "history.csv"), content(out("parts") / "history.csv"));
}

TEST_F(RunTest, ResumingWithoutACheckpointStartsAfresh) {
  EXPECT_EQ(run_all("afresh", true), RunOutcome::Finished);
  EXPECT_TRUE(fs::exists(out("afresh") / "summary.json"));
}

TEST_F(RunTest, ADamagedCheckpointIsRefusedInOneLine) {
  run_until(0.03, "run", false);  // one checkpoint, at 20 ms
  const fs::path file = out("run") / "checkpoint" / "state.bin";
  const std::string whole = content(file);
  ASSERT_GT(whole.size(), 500U);
  std::ofstream(file, std::ios::binary) << whole.substr(0, whole.size() / 2);
  EXPECT_NE(refusal("run").find("not a whole checkpoint"), std::string::npos);
  EXPECT_EQ(refusal("run").find('\n'), std::string::npos);
}

TEST_F(RunTest, WhereTheNewestCheckpointIsDamagedTheOneBeforeGivesTheSameFiles) {
  run_all("whole");
  run_until(0.05, "parts", false);
  ASSERT_TRUE(fs::exists(out("parts") / "checkpoint" / "previous.bin"));
  folder_.file("parts/checkpoint/state.bin", "torn");
  run_all("parts", true);
  expect_same_files(out("whole"), out("parts"));
}

// A run that was killed, or whose disk was full, leaves half a row, a frame that is not listed,
// and a series without an end.
TEST_F(RunTest, WhatAKilledRunLeftBehindItsCheckpointIsRepaired) {
  run_all("whole");
  run_until(0.033, "parts", false);
  std::ofstream(out("parts") / "history.csv", std::ios::app) << "0.034,1.5,2.";
  std::ofstream(out("parts") / "frames" / "block_000009.vtu.part") << "<VTK";
  const std::string series = content(out("parts") / "scene.pvd");
  folder_.file("parts/scene.pvd", series.substr(0, series.size() - 10));
  run_all("parts", true);
  fs::remove(out("parts") / "frames" / "block_000009.vtu.part");
  expect_same_files(out("whole"), out("parts"));
}

TEST_F(RunTest, ResumingIsRefusedWhereResultsAreNotAsTheyWere) {
  run_until(0.033, "run", false);
  const fs::path history = out("run") / "history.csv";
  const std::string rows = content(history);
  std::string edited = rows;
  edited[rows.size() / 3] = edited[rows.size() / 3] == '7' ? '8' : '7';
  folder_.file("run/history.csv", edited);
  EXPECT_NE(refusal("run").find("history.csv: does not begin with"), std::string::npos);
  fs::remove(history);
  EXPECT_NE(refusal("run").find("history.csv: does not begin with"), std::string::npos);
  folder_.file("run/history.csv", rows);
  fs::remove(out("run") / "frames" / "block_000001.vtu");
  EXPECT_NE(refusal("run").find("frames/block_000001.vtu"), std::string::npos);
}

// As it stands while a run goes on, and for good where it is killed.
TEST_F(RunTest, ASummarySaysFinishedOnlyOfARunThatHasFinished) {
  const auto outcome = [&] {
    return nlohmann::json::parse(content(out("run") / "summary.json")).at("outcome");
  };
  std::vector<std::string> seen;
  RunOptions options;
  options.directory = out("run");
  options.after_step = [&](const State& state, double) {
    seen.push_back(outcome());
    return state.t >= 0.03;
  };
  run_with(options, {"duration=40 ms"});
  EXPECT_EQ(outcome(), "interrupted");
  options.resume = true;
  options.after_step = [&](const State&, double) {
    seen.push_back(outcome());
    return false;
  };
  run_with(options, {"duration=40 ms"});
  EXPECT_EQ(outcome(), "finished");
  EXPECT_EQ(seen, std::vector<std::string>(seen.size(), "unfinished"));
}

TEST_F(RunTest, FramesThatTheDiskCanNotHoldAreRefusedBeforeAnythingIsWritten) {
  try {
    run_all("run", false, {"output.interval=1e-15 s"});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("6e+13 frames of "), std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(fs::exists(out("run") / "history.csv"));
}

TEST_F(RunTest, ACheckpointOfAnotherScenarioIsRefusedInOneLine) {
  run_until(0.03, "run", false);
  for (const char* change :
       {"integrator.step=0.5 ms", "body.block.material.young_modulus=30 kPa",
        "body.block.density=900 kg/m^3", "muscle.puller.max_force=1 N",
        "load.0.acceleration=0 0 -9 m/s^2", "probe.plate.point=1 0 12 mm",
        "body.block.geometry.box.cells=[2, 2, 3]", "ligament.band.stiffness=6 N/m"}) {
    const std::string message = refusal("run", {change});
    EXPECT_NE(message.find("belongs to another scenario"), std::string::npos) << change;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  EXPECT_EQ(refusal("run"), "");
}

}  // namespace articular::sim::run_resume_test
