#include "sim/output/checkpoint.hpp"
#include "sim/output/fingerprint.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::checkpoint_test {

std::vector<double> numbers(const EnergyLedger& l) {
  return {l.muscle_work, l.load_work,    l.motion_work,   l.ligament_loss, l.bolus_loss,
          l.tissue_loss, l.contact_loss, l.settling_loss, l.start};
}

std::vector<double> numbers(const RunExtrema& e) {
  std::vector<double> all{e.kinetic, e.work, e.moved_at, e.made, e.gravity_low, e.gravity_high};
  for (const ExtremeVolume& volume : {e.least, e.largest})
    all.insert(all.end(), {volume.ratio, double(volume.tissue), double(volume.element), volume.at});
  for (const WorstContact& worst : {e.overlap, e.layer, e.driven})
    all.insert(all.end(), {worst.value, double(worst.of), worst.at});
  all.insert(all.end(), {e.strain.value, double(e.strain.of), e.strain.at});
  const Snap& snap = e.snap;
  all.insert(all.end(), {double(snap.body), snap.at, snap.motion, snap.expected, snap.loss});
  return all;
}

std::vector<std::int64_t> numbers(const Counts& c) {
  return {c.steps,
          c.rejected_newton,
          c.newton_iterations,
          c.factorizations,
          c.projected_tangents,
          c.linear_solves,
          c.linear_iterations,
          c.force_evaluations,
          c.rejected_motion,
          c.tree_updates,
          c.narrow_tests,
          c.reported_pairs,
          c.deep_pairs};
}

/// Every number another one.
State some_state() {
  State s;
  s.t = 0.1;
  s.y = Eigen::VectorXd::LinSpaced(17, 1.0 / 3, 2);
  s.next_step = 1e-3 / 7;
  s.next_margin = 2e-4 / 3;
  s.max_penetration = 3e-5;
  s.frames = 12;
  s.energy = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  s.counts.steps = 1;
  s.counts.rejected_newton = 2;
  s.counts.newton_iterations = 3;
  s.counts.factorizations = 4;
  s.counts.projected_tangents = 5;
  s.counts.linear_solves = 6;
  s.counts.linear_iterations = 7;
  s.counts.force_evaluations = 8;
  s.counts.rejected_motion = 9;
  s.counts.tree_updates = 10;
  s.counts.narrow_tests = 11;
  s.counts.reported_pairs = 12;
  s.counts.deep_pairs = 13;
  s.overlap_resolution = {{{1, 0.2, 0.3}, {2, 0.4, 0.5}}, 3, 7, 0.6};
  s.extrema = {{0.1, 2, 3, 0.4},
               {3.1, 1, 4, 0.3},
               {0.5, 6, 0.7},
               {0.8, 9, 1.0},
               {1.1, 12, 1.3},
               {0.9, 13, 1.4},
               {14, 1.5, 1.6, 1.7, 1.8},
               1.9,
               2.0,
               2.1,
               2.2,
               2.3,
               2.4};
  s.wraps = {{{0, 7, true, 0.25}, {1, 8, false, 0.75}}, {}, {{2, 9, true, 1.0 / 3}}};
  s.boluses = {{0.02, 0.003, 0.002, 0.7}, {}};
  return s;
}

TEST(Checkpoint, KeepsEveryNumberOfAState) {
  const TemporaryFolder folder;
  const Checkpoint whole{some_state(), {1, 2}, {3, 4}, {5, 6}};
  write_checkpoint(folder.path(), whole, "scene");
  const Checkpoint again = read_checkpoint(folder.path(), "scene", {}).value();
  EXPECT_EQ(again.history, whole.history);
  EXPECT_EQ(again.series, whole.series);
  ASSERT_EQ(again.state.wraps.size(), whole.state.wraps.size());
  for (std::size_t k = 0; k < whole.state.wraps.size(); ++k) {
    ASSERT_EQ(again.state.wraps[k].size(), whole.state.wraps[k].size());
    for (std::size_t i = 0; i < whole.state.wraps[k].size(); ++i) {
      const EdgeCrossing &a = again.state.wraps[k][i], &b = whole.state.wraps[k][i];
      EXPECT_EQ(a.surface, b.surface);
      EXPECT_EQ(a.edge, b.edge);
      EXPECT_EQ(a.forward, b.forward);
      EXPECT_EQ(a.t, b.t);
    }
  }
  ASSERT_EQ(again.state.boluses.size(), whole.state.boluses.size());
  for (std::size_t k = 0; k < whole.state.boluses.size(); ++k) {
    EXPECT_EQ(again.state.boluses[k].height, whole.state.boluses[k].height);
    EXPECT_EQ(again.state.boluses[k].deepest, whole.state.boluses[k].deepest);
    EXPECT_EQ(again.state.boluses[k].let_go, whole.state.boluses[k].let_go);
    EXPECT_EQ(again.state.boluses[k].strength, whole.state.boluses[k].strength);
  }
  EXPECT_EQ(again.convergence, whole.convergence);
  const State &given = whole.state, &read = again.state;
  EXPECT_EQ(read.t, given.t);
  EXPECT_EQ(read.y, given.y);
  EXPECT_EQ(read.next_step, given.next_step);
  EXPECT_EQ(read.next_margin, given.next_margin);
  EXPECT_EQ(read.max_penetration, given.max_penetration);
  EXPECT_EQ(read.frames, given.frames);
  EXPECT_EQ(numbers(read.energy), numbers(given.energy));
  EXPECT_EQ(numbers(read.counts), numbers(given.counts));
  EXPECT_EQ(numbers(read.extrema), numbers(given.extrema));
  const OverlapResolution &found = read.overlap_resolution, &told = given.overlap_resolution;
  EXPECT_EQ(found.solutions, told.solutions);
  EXPECT_EQ(found.iterations, told.iterations);
  EXPECT_EQ(found.largest_motion, told.largest_motion);
  ASSERT_EQ(found.overlaps.size(), told.overlaps.size());
  for (std::size_t k = 0; k < told.overlaps.size(); ++k) {
    EXPECT_EQ(found.overlaps[k].contact, told.overlaps[k].contact);
    EXPECT_EQ(found.overlaps[k].before, told.overlaps[k].before);
    EXPECT_EQ(found.overlaps[k].after, told.overlaps[k].after);
  }
}

// The newest one damaged in any way, the one before serves; both, and nothing does.
TEST(Checkpoint, TheOneBeforeServesWhereTheNewestIsDamaged) {
  const TemporaryFolder folder;
  EXPECT_FALSE(read_checkpoint(folder / "checkpoint", "scene", {}));
  Checkpoint checkpoint{some_state(), {}, {}, {}};
  for (const double t : {0.1, 0.2, 0.3}) {
    checkpoint.state.t = t;
    write_checkpoint(folder / "checkpoint", checkpoint, "scene");
  }
  std::vector<std::string> warnings;
  const auto warn = [&](const std::string& warning) { warnings.push_back(warning); };
  const auto time = [&] { return read_checkpoint(folder / "checkpoint", "scene", warn)->state.t; };
  EXPECT_EQ(time(), 0.3);
  EXPECT_TRUE(warnings.empty());
  const std::string newest = content(folder / "checkpoint/state.bin"),
                    before = content(folder / "checkpoint/previous.bin");
  for (std::size_t size = 0; size < newest.size(); size += 7) {
    std::string flipped = newest;
    flipped[size] ^= 4;
    for (const std::string& damaged : {newest.substr(0, size), flipped}) {
      folder.file("checkpoint/state.bin", damaged);
      folder.file("checkpoint/previous.bin", before);
      EXPECT_EQ(time(), 0.2);
    }
  }
  EXPECT_NE(warnings.back().find("state.bin is not a whole checkpoint"), std::string::npos);
  folder.file("checkpoint/previous.bin", before);
  std::filesystem::remove(folder / "checkpoint/state.bin");  // killed between two renames
  EXPECT_EQ(time(), 0.2);
  for (const char* const name : {"checkpoint/state.bin", "checkpoint/previous.bin"})
    folder.file(name, "");
  EXPECT_THROW(read_checkpoint(folder / "checkpoint", "scene", warn), InputError);
}

/// Of a scene of one mesh, as tissue or as a fixed body; nothing in the scenario itself tells
/// meshes apart.
std::string fingerprint_of(const MeshData& mesh, Body::Kind kind) {
  const TemporaryFolder folder;
  Scenario s = scene(1e-3);
  s.bodies = {mesh_body("body", kind, mesh, folder)};
  return fingerprint(s, build_model(s));
}

TEST(Checkpoint, BelongsToTheMeshThatWasRead) {
  const MeshData mesh = box_mesh({Vec3::Constant(0.02), {2, 2, 2}, Vec3::Zero()});
  MeshData moved = mesh, ordered = mesh;
  moved.X(0, 0) += 1e-9;
  ordered.tets.col(0).swap(ordered.tets.col(1));
  for (const Body::Kind kind : {Body::Kind::Tissue, Body::Kind::Fixed}) {
    EXPECT_EQ(fingerprint_of(mesh, kind), fingerprint_of(mesh, kind));
    EXPECT_NE(fingerprint_of(mesh, kind), fingerprint_of(moved, kind));
  }
  // Results of a tissue depend on the order of its elements, to round-off.
  EXPECT_NE(fingerprint_of(mesh, Body::Kind::Tissue), fingerprint_of(ordered, Body::Kind::Tissue));
}

}  // namespace articular::sim::checkpoint_test
