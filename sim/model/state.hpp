#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "sim/base/evaluation_counters.hpp"
#include "sim/model/contact_pairs.hpp"
#include "sim/wrap/taut_string.hpp"

namespace articular::sim {

/// Work done and energy lost since the start [J].
struct EnergyLedger {
  double muscle_work = 0;    // by active muscle force
  double load_work = 0;      // by forces and moments of the scenario (gravity is a stored energy)
  double motion_work = 0;    // by what drives prescribed motions
  double ligament_loss = 0;  // in ligaments' dampers
  double bolus_loss = 0;     // by food that is crushed
  double tissue_loss = 0;    // in tissues' dampers
  double contact_loss = 0;   // by friction and dampers in contact
  double settling_loss = 0;  // against pseudo-time damping of a static analysis
  double start = 0;          // stored and kinetic energy at t = 0
};

/// What SUNDIALS did.
struct SolverCounts {
  std::int64_t steps = 0;            // taken
  std::int64_t rejected_newton = 0;  // Newton's iteration did not converge: step halved
  std::int64_t newton_iterations = 0;
  std::int64_t factorizations = 0;
  std::int64_t projected_tangents = 0;  // matrices that were not positive definite as they came
  std::int64_t linear_solves = 0;
  std::int64_t linear_iterations = 0;
  std::int64_t force_evaluations = 0;
};

SolverCounts operator+(SolverCounts a, const SolverCounts& b);
SolverCounts operator-(SolverCounts a, const SolverCounts& b);

struct Counts : SolverCounts {
  std::int64_t rejected_motion = 0;  // something moved farther than the detection covered
  std::int64_t tree_updates = 0;
  std::int64_t narrow_tests = 0;
  std::int64_t reported_pairs = 0;
  std::int64_t deep_pairs = 0;  // contact candidates deeper than usual: see ContactSearch
  EvaluationCounts evaluations;
};

/// How far two bodies overlapped before and after they were set apart [m], the deepest point of
/// either.
struct ResolvedOverlap {
  ContactId contact = 0;
  double before = 0, after = 0;
};

/// What set overlapping bodies apart before the start.
struct OverlapResolution {
  std::vector<ResolvedOverlap> overlaps;
  int solutions = 0;          // equilibria
  int iterations = 0;         // Newton's, in all of them
  double largest_motion = 0;  // [m] of a node
};

/// Of all things of a kind the one where it was largest, and when. @tparam Which  its index
template <class Which>
struct Worst {
  double value = 0;
  Which of = -1;
  double at = 0;  // [s]
};
using WorstContact = Worst<ContactId>;
using WorstLigament = Worst<int>;

/// A load step of a static analysis that did not follow its equilibrium: what buckles or snaps
/// through goes on to another one.
struct Snap {
  int body = -1;        // that moved farthest; -1: there was none
  double at = 0;        // [s]
  double motion = 0;    // [m] of that body
  double expected = 0;  // [m] by the stiffness where it began
  double loss = 0;      // [J]
};

/// The element whose volume was least or largest by that at rest.
struct ExtremeVolume {
  double ratio = 1;
  int tissue = -1;
  std::int64_t element = -1;
  double at = 0;  // [s]
};

/// Extreme values at the start or the end of any step, for warnings.
struct RunExtrema {
  ExtremeVolume least, largest;
  WorstContact overlap;  // by the depth that their contact can follow
  WorstContact layer;    // by the thickness of the layers between them
  WorstContact driven;   // [m] of rigid bodies that the scenario moves, with no layer between
  WorstLigament strain;  // [-] of its slack length; of those that are not linear
  Snap snap;             // the first one
  double kinetic = 0;    // [J], largest
  double work = 0;       // [J], largest sum of what muscles, loads and driven motions had done
  double moved_at = 0;   // [s], last with kinetic energy that counts beside what was turned over
  double made = 0;       // [J], most that had come from nowhere when a frame was written
  double gravity_low = std::numeric_limits<double>::infinity();  // [J]
  double gravity_high = -std::numeric_limits<double>::infinity();
};

/// The edges that lines cross, of each string of each line that wraps in the order of the model:
/// where the next path is pulled from.
using WrapHistory = std::vector<std::vector<EdgeCrossing>>;

/// Of a place that a probe follows.
struct Way {
  double x = 0, y = 0, z = 0;  // where it began [m]
  double length = 0;           // of all steps [m]
};

/// Of food: see sim/lines/bolus_law.hpp.
struct BolusState {
  double height = 0;    // [m] before it was crushed; 0: it is not there yet
  double deepest = 0;   // [m] so far
  double let_go = 0;    // [m] the deepest when it was let go last
  double strength = 1;  // share of Bolus::force that is left
};

/// All that changes: a copy of it at a checkpoint is a restart point.
struct State {
  double t = 0;                // [s]
  Eigen::VectorXd y;           // in the order of Layout
  double next_step = 0;        // [s]
  double next_margin = 0;      // [m] of the next detection
  double max_penetration = 0;  // [m] largest so far
  int frames = 0;              // written
  WrapHistory wraps;
  std::vector<BolusState> boluses;
  std::vector<Way> ways;  // see ObservedWay
  EnergyLedger energy;
  Counts counts;
  OverlapResolution overlap_resolution;
  RunExtrema extrema;
};

}  // namespace articular::sim
