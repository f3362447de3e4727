#include "sim/statics/soft_motion.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "sim/assembly/rigid_body_modes.hpp"
#include "sim/model/held_blocks.hpp"
#include "sim/model/newton_weights.hpp"
#include "sim/statics/load_prediction.hpp"
#include "sim/statics/random_blocks.hpp"

namespace articular::sim {
namespace {

/// Of inverse iteration from a random start. Motions that are alike soft are not told apart by
/// then, and need not be.
constexpr int kIterations = 15;
/// Of the fastest rate K_ii/m_i: added by mass, so that a matrix with a free motion can be solved
/// with. It shifts eigenvalues and leaves their vectors.
constexpr double kShift = 1e-10;
/// A body takes part in a motion if it moves by this part of what moves farthest.
constexpr double kTakesPart = 1.0 / 3;

/// Rigid motion that fits a body's best.
struct RigidFit {
  Vec3 shift = Vec3::Zero(), turn = Vec3::Zero(), center = Vec3::Zero();
  double radius = 0, farthest = 0;
};

RigidFit fit_of(const Positions& x, const Positions& u) {
  RigidFit fit;
  fit.center = x.rowwise().mean();
  fit.shift = u.rowwise().mean();
  Mat3 inertia = Mat3::Zero();
  Vec3 moment = Vec3::Zero();
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Vec3 r = x.col(i) - fit.center;
    inertia += r.squaredNorm() * Mat3::Identity() - r * r.transpose();
    moment += r.cross(u.col(i));
    fit.radius = std::max(fit.radius, r.norm());
    fit.farthest = std::max(fit.farthest, u.col(i).norm());
  }
  fit.turn = inertia.completeOrthogonalDecomposition().solve(moment);
  return fit;
}

RigidFit fit_of(const Moment& now, std::size_t r, const Eigen::VectorXd& motion) {
  const RigidBody& rigid = now.model.rigid_bodies[r];
  RigidFit fit;
  fit.center = now.configuration.poses[r].p;
  fit.shift = motion.segment<3>(3 * rigid.block);
  fit.turn = motion.segment<3>(3 * rigid.block + 3);
  fit.radius = turning_radius(rigid);
  fit.farthest = std::max(fit.shift.norm(), fit.radius * fit.turn.norm());
  return fit;
}

/// By body; those without unknowns have none.
std::vector<std::pair<int, RigidFit>> fits_of(const Moment& now, const Eigen::VectorXd& motion) {
  std::vector<std::pair<int, RigidFit>> fits;
  Positions u;
  for (std::size_t b = 0; b < now.model.bodies.size(); ++b) {
    const BodyModel& body = now.model.bodies[b];
    if (body.tissue >= 0) {
      const auto t = static_cast<std::size_t>(body.tissue);
      displacements_of(now, t, motion, u);
      Positions x;
      positions_of(now.configuration, now.model.tissues[t].nodes, x);
      fits.emplace_back(static_cast<int>(b), fit_of(x, u));
    } else if (body.rigid >= 0 && body.rigid < now.model.layout.num_rigid) {
      fits.emplace_back(static_cast<int>(b),
                        fit_of(now, static_cast<std::size_t>(body.rigid), motion));
    }
  }
  return fits;
}

/// What moves a tissue is told of the bone that it is tied to, where that moves as far.
bool rides_on_another(const Model& model, int body, const std::vector<BodyMotion>& told) {
  const int t = model.bodies[static_cast<std::size_t>(body)].tissue;
  if (t < 0) return false;
  const Tissue& tissue = model.tissues[static_cast<std::size_t>(t)];
  return std::any_of(tissue.nodes.begin(), tissue.nodes.end(), [&](const NodeRef& node) {
    if (node.rigid < 0) return false;
    const int bone = model.rigid_bodies[static_cast<std::size_t>(node.rigid)].body;
    return std::any_of(told.begin(), told.end(),
                       [&](const BodyMotion& other) { return other.body == bone; });
  });
}

std::vector<BodyMotion> body_motions(const Model& model,
                                     std::vector<std::pair<int, RigidFit>> fits) {
  // Bones before the tissue that they carry.
  std::stable_sort(fits.begin(), fits.end(), [&](const auto& a, const auto& b) {
    const bool rigid_a = model.bodies[static_cast<std::size_t>(a.first)].tissue < 0;
    const bool rigid_b = model.bodies[static_cast<std::size_t>(b.first)].tissue < 0;
    return rigid_a != rigid_b ? rigid_a : a.second.farthest > b.second.farthest;
  });
  std::vector<BodyMotion> motions;
  for (const auto& [body, fit] : fits) {
    if (fit.farthest < kTakesPart || rides_on_another(model, body, motions)) continue;
    motions.push_back(
        {body, fit.farthest, rigid_motion_in_words(fit.shift, fit.radius * fit.turn, fit.center)});
  }
  std::stable_sort(motions.begin(), motions.end(), [](const BodyMotion& a, const BodyMotion& b) {
    return a.distance > b.distance;
  });
  return motions;
}

}  // namespace

std::optional<SoftMotion> find_softest_motion(const Model& model, Dynamics& dynamics,
                                              Equilibrium& equilibrium) {
  const Eigen::Index n = 3 * model.layout.num_unknown_blocks();
  if (n == 0 || !dynamics.now().forces.allFinite()) return std::nullopt;
  const double shift = kShift * fastest_rate(model, dynamics);
  if (!equilibrium.linearise(shift)) return std::nullopt;

  Eigen::VectorXd motion = random_blocks(n), inertia, next;
  double energy = 0;  // φᵀ K φ of the last iterate
  for (int k = 0; k < kIterations; ++k) {
    keep_free_part(model, motion);
    dynamics.multiply_mass(motion, inertia);
    const double mass = motion.dot(inertia);
    if (!(mass > 0)) return std::nullopt;
    inertia /= std::sqrt(mass);
    keep_free_part(model, inertia);
    if (!equilibrium.respond(inertia, next)) return std::nullopt;
    motion = next;  // (K + d M) φ is the inertia of the one before
    keep_free_part(model, motion);
    energy = motion.dot(inertia);
  }
  dynamics.multiply_mass(motion, inertia);
  energy -= shift * motion.dot(inertia);

  std::vector<std::pair<int, RigidFit>> fits = fits_of(dynamics.now(), motion);
  double farthest = 0;
  for (const auto& [body, fit] : fits) farthest = std::max(farthest, fit.farthest);
  if (!(farthest > 0)) return std::nullopt;
  for (auto& [body, fit] : fits) {
    fit.shift /= farthest;
    fit.turn /= farthest;
    fit.farthest /= farthest;
  }
  SoftMotion softest;
  softest.blocks = motion / farthest;
  softest.stiffness = std::max(0.0, energy / (farthest * farthest));
  softest.force = std::abs(softest.blocks.dot(dynamics.now().forces.head(n)));
  softest.bodies = body_motions(model, std::move(fits));
  return softest;
}

}  // namespace articular::sim
