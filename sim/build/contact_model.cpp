#include "sim/build/contact_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

/// Contact stiffness of a side is this times modulus / element height. From a thousand
/// on forces of averaged depths no longer depend on it. Statics ends there and begins softer: from
/// afar a stiff iteration is thrown back and forth. In time, where that ends by how far things
/// still move, it takes the accurate preset's tolerance, which asks for it: what is left of motion
/// is noise of the forces; by other tolerances a tenth of it is enough. Explicit steps are as long
/// as the stiffness lets them. Two rigid bodies, which give way nowhere, have nothing of it.
constexpr double kSoftFactor = 10, kFirmFactor = 100, kStiffFactor = 1000;

/// The modulus is the constrained one, as of a column between its neighbours, but at most so many
/// punch moduli: near ν = 0.5 a column gives way a hundred or a thousand times less than a spot of
/// the surface does, and contact that is as stiff throws Newton's iteration back and forth. Up to
/// ν = 0.41 (statics: 0.494) that is no limit. Statics, whose residual and line search bear more,
/// gets more: a thin layer that is bonded to bone can give way no more than a column.
constexpr double kMostPunches = 1, kMostPunchesAtRest = 10;

/// What the compliance of a body's side is to be multiplied by for that: 1 of rigid bodies.
double softening(const Model& model, int body) {
  const int t = model.bodies[static_cast<std::size_t>(body)].tissue;
  if (t < 0) return 1;
  const Tissue& tissue = model.tissues[static_cast<std::size_t>(t)];
  const double most = model.is_static ? kMostPunchesAtRest : kMostPunches;
  return std::max(1.0, constrained_modulus(tissue) / (most * punch_modulus(tissue)));
}

/// Of the elements at the surface: what friction at 0.7 of its limit creeps in a second, or in a
/// thousand steps where these take longer. A finer step creeps no faster, and a scene of hours with
/// long steps no farther than one of seconds.
constexpr double kCreep = 0.05, kCreepTime = 1, kCreepSteps = 1000;

/// Of the elements at the surface.
constexpr double kMaxPenetration = 0.01;

double mean_face_area(const Collider& collider) {
  return std::accumulate(collider.face_area.begin(), collider.face_area.end(), 0.0) /
         static_cast<double>(std::max<std::size_t>(1, collider.face_area.size()));
}

/// Whose triangles look for the other's faces, and at whose nodes depths are averaged: of tissue
/// where it meets rigid body, of the softer or, much alike, the finer of two tissues, of the finer
/// of two rigid bodies. Both sides at once would hold the bodies apart at more nodes than the
/// coarser one has to give way with, and cost twice as much.
bool is_nonmortar(const Model& model, int a, int b, const Collider& A, const Collider& B) {
  constexpr double kMuchSofter = 3;
  const auto modulus = [&](int body) {
    const int tissue = model.bodies[static_cast<std::size_t>(body)].tissue;
    return punch_modulus(model.tissues[static_cast<std::size_t>(tissue)]);
  };
  const bool soft_a = model.bodies[static_cast<std::size_t>(a)].tissue >= 0;
  const bool soft_b = model.bodies[static_cast<std::size_t>(b)].tissue >= 0;
  if (soft_a != soft_b) return soft_a;
  if (soft_a && modulus(a) > kMuchSofter * modulus(b)) return false;
  if (soft_a && modulus(b) > kMuchSofter * modulus(a)) return true;
  return mean_face_area(A) <= mean_face_area(B);
}

void add_contact(const Scenario& scenario, int a, int b, const ContactPair& pair, Model& model) {
  const auto& A = model.bodies[static_cast<std::size_t>(a)].collider;
  const auto& B = model.bodies[static_cast<std::size_t>(b)].collider;
  if (!A || !B) return;
  ContactModel contact;
  contact.a = a;
  contact.b = b;
  const bool is_static = model.is_static;
  const Scenario::Response response = scenario.contact_response;
  // In time two rigid bodies count depths point by point: there is no tissue whose facets averages
  // let give way, and where edges slip off each other stiff contact would make energy.
  const bool has_tissue = model.bodies[static_cast<std::size_t>(a)].tissue >= 0 ||
                          model.bodies[static_cast<std::size_t>(b)].tissue >= 0;
  contact.averaged = is_static || (has_tissue && response == Scenario::Response::Averaged);
  contact.share = a == b ? 0.5 : 1;
  const double factor = contact_stiffness_factor(scenario, contact.averaged);
  const double layers = A->layer_compliance + B->layer_compliance;
  const double mean_a = softening(model, a) * A->mean_compliance;
  const double mean_b = softening(model, b) * B->mean_compliance;
  contact.mean_stiffness = 1 / ((mean_a + mean_b) / factor + layers);
  contact.max_penetration = kMaxPenetration * std::min(A->size, B->size);
  // The depth of a layer is its own compression.
  contact.is_bounded = layers == 0 && is_static;
  contact.reversed = a != b && !is_nonmortar(model, a, b, *A, *B);
  const Collider& nonmortar = contact.reversed ? *B : *A;
  const double softened = softening(model, contact.reversed ? b : a);
  const double mean_other = contact.reversed ? mean_a : mean_b;
  const auto of_groups = [&](double c) {
    if (!contact.averaged)
      return Eigen::VectorXd::Constant(std::ssize(nonmortar.group_node),
                                       contact.share * contact.mean_stiffness)
          .eval();
    const Eigen::ArrayXd compliance = softened * nonmortar.compliance(nonmortar.group_node).array();
    return (contact.share / ((compliance + mean_other) / c + layers)).matrix().eval();
  };
  contact.stiffness = of_groups(factor);
  contact.soft = of_groups(kSoftFactor);
  contact.law.friction = pair.friction;
  contact.law.damping = contact.share * pair.damping;
  contact.law.slip_velocity =
      pair.slip_velocity.value_or(kCreep * std::min(A->size, B->size) /
                                  std::max(kCreepTime, kCreepSteps * scenario.integrator.step));
  model.contacts.push_back(std::move(contact));
}

}  // namespace

double contact_stiffness_factor(const Scenario& scenario, bool averaged) {
  if (scenario.analysis == Scenario::Analysis::Static) return kStiffFactor;
  if (!averaged) return kSoftFactor;
  if (scenario.contact_stiffness_factor) return *scenario.contact_stiffness_factor;
  const bool is_explicit = scenario.integrator.scheme == Integrator::Scheme::Explicit;
  return is_explicit ? kSoftFactor : kFirmFactor;
}

void make_contacts(const Scenario& scenario, Model& model) {
  if (!scenario.contact) return;
  for (const ContactPair& pair : scenario.contacts) {
    const int a = body_index(scenario, pair.a), b = body_index(scenario, pair.b);
    for (const int body : {a, b})
      if (!model.bodies[static_cast<std::size_t>(body)].collider)
        throw InputError(pair.where,
                         fmt::format("body `{}` has nothing to touch with: it needs a mesh and "
                                     "must not have collides = false",
                                     model.bodies[static_cast<std::size_t>(body)].name));
    add_contact(scenario, a, b, pair, model);
  }
  if (!scenario.contacts.empty()) return;
  const auto n = static_cast<int>(model.bodies.size());
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) {
      const auto fixed = [&](int body) {
        return model.bodies[static_cast<std::size_t>(body)].kind == Body::Kind::Fixed;
      };
      if (!(fixed(a) && fixed(b))) add_contact(scenario, a, b, ContactPair{}, model);
    }
}

double detection_margin(const Model& model) {
  constexpr double kMarginOfElement = 0.1;
  double least = std::numeric_limits<double>::infinity();
  for (const BodyModel& body : model.bodies)
    if (body.collider) least = std::min(least, body.collider->size);
  return std::isfinite(least) ? kMarginOfElement * least : 0;
}

}  // namespace articular::sim
