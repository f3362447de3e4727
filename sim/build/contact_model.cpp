#include "sim/build/contact_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/model/tissue.hpp"
#include "sim/scenario/name_pattern.hpp"

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

/// What of a body's side decides how it touches others.
struct Side {
  bool is_there = false;  // it can touch something
  bool is_tissue = false, is_fixed = false;
  double softening = 1;   // what the compliance is to be multiplied by for that: 1 of rigid bodies
  double compliance = 0;  // mean one of the surface, softened [m/Pa]
  double layer = 0;       // compliance of the layer on it, at no depth [m/Pa]
  LogarithmicLayer logarithmic;  // of that layer, where it stiffens
  double size = 0;               // mean height of the elements at the surface [m]
  double mean_face_area = 0;     // [m²]
  bool is_fine = false;          // tissue whose surface can tell where within a face it is pressed
  double modulus = 0;            // of a punch, of tissue [Pa]
};

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

/// Whether most of a surface has them. Depths are averaged around nodes; where every node of a face
/// is on a crease, as on a cube of one cell, a mean can't tell where within the face a load is
/// carried. A block then stands as if its base ended a third of an element sooner, and tips.
bool has_nodes_between_creases(const Collider& collider) {
  std::vector<char> on_crease(collider.group_node.size(), 0);
  const auto mark = [&](Eigen::Index face, int corner) {
    on_crease[static_cast<std::size_t>(collider.groups(corner % 3, face))] = 1;
  };
  for (Eigen::Index f = 0; f < collider.groups.cols(); ++f)
    for (int k = 0; k < 3; ++k)
      if ((collider.rims[static_cast<std::size_t>(f)] >> k & 1U) != 0) {
        mark(f, k + 1);
        mark(f, k + 2);
      }
  double fine = 0, all = 0;  // [m²]
  for (Eigen::Index f = 0; f < collider.groups.cols(); ++f) {
    const auto groups = collider.groups.col(f);
    const bool is_fine = std::any_of(groups.begin(), groups.end(), [&](int group) {
      return on_crease[static_cast<std::size_t>(group)] == 0;
    });
    const double area = collider.face_area[static_cast<std::size_t>(f)];
    all += area;
    if (is_fine) fine += area;
  }
  return fine >= 0.5 * all;
}

Side side_of(const Model& model, const BodyModel& body) {
  Side side;
  if (!body.collider) return side;
  side.is_there = true;
  side.is_fixed = body.kind == Body::Kind::Fixed;
  side.is_tissue = body.tissue >= 0;
  if (side.is_tissue) {
    const Tissue& tissue = model.tissues[static_cast<std::size_t>(body.tissue)];
    const double most = model.is_static ? kMostPunchesAtRest : kMostPunches;
    // Muscle presses on what it bends around by its tension, whatever its ground substance is, and
    // most at few nodes (sim/RESULTS.md).
    constexpr double kPressByTension = 2.5;
    side.modulus = punch_modulus(tissue) + kPressByTension * tissue.active_stress;
    side.softening = std::max(1.0, constrained_modulus(tissue) / (most * side.modulus));
  }
  side.compliance = side.softening * body.collider->mean_compliance;
  side.layer = body.collider->layer_compliance;
  if (body.collider->layer_stiffens)
    side.logarithmic = {body.collider->layer_thickness / side.layer,
                        body.collider->layer_thickness};
  side.size = body.collider->size;
  side.mean_face_area = mean_face_area(*body.collider);
  side.is_fine = side.is_tissue && has_nodes_between_creases(*body.collider);
  return side;
}

/// Whose triangles look for the other's faces, and at whose nodes depths are averaged: of tissue
/// where it meets rigid body, of the softer or, much alike, the finer of two tissues, of the finer
/// of two rigid bodies. Both sides at once would hold the bodies apart at more nodes than the
/// coarser one has to give way with, and cost twice as much.
bool is_nonmortar(const Side& a, const Side& b) {
  constexpr double kMuchSofter = 3;
  if (a.is_tissue != b.is_tissue) return a.is_tissue;
  if (a.is_tissue && a.modulus > kMuchSofter * b.modulus) return false;
  if (a.is_tissue && b.modulus > kMuchSofter * a.modulus) return true;
  return a.mean_face_area <= b.mean_face_area;
}

/// Makes pairs of a scene's bodies: all that it needs of scene and bodies.
struct PairMaker {
  std::vector<Side> sides;  // one a body
  bool is_static = false;
  Scenario::Response response = Scenario::Response::Averaged;
  double factor_of_averages = 1, factor_of_points = 1;
  double step = 0;  // [s]

  PairMaker(const Scenario& scenario, const Model& model)
      : is_static(model.is_static),
        response(scenario.contact_response),
        factor_of_averages(contact_stiffness_factor(scenario, true)),
        factor_of_points(contact_stiffness_factor(scenario, false)),
        step(scenario.integrator.step) {
    for (const BodyModel& body : model.bodies) sides.push_back(side_of(model, body));
  }

  ContactModel make(int a, int b, const ContactPair& pair) const {
    const Side &A = sides[static_cast<std::size_t>(a)], &B = sides[static_cast<std::size_t>(b)];
    ContactModel contact;
    contact.a = a;
    contact.b = b;
    contact.reversed = a != b && !is_nonmortar(A, B);
    const Side& nonmortar = contact.reversed ? B : A;
    // In time two rigid bodies count depths point by point: there is no tissue whose facets
    // averages let give way, and where edges slip off each other stiff contact would make energy.
    // So does an elastic layer between them in statics, whose springs side by side averages would
    // blur. A layer that stiffens has averages always: as soft as it is at its edges it makes no
    // energy, and there is no polynomial of the depth to be integrated exactly over a patch.
    contact.logarithmic = {A.logarithmic, B.logarithmic};
    contact.layers = A.layer + B.layer;
    const bool is_foundation = !A.is_tissue && !B.is_tissue && contact.layers > 0;
    const bool is_firm = is_static || contact.stiffens() ||
                         (nonmortar.is_tissue && response == Scenario::Response::Averaged);
    contact.averaged =
        contact.stiffens() || (is_static ? !is_foundation : is_firm && nonmortar.is_fine);
    contact.share = a == b ? 0.5 : 1;
    contact.factor = is_firm ? factor_of_averages : factor_of_points;
    contact.soft_factor = kSoftFactor;
    contact.mean_stiffness = 1 / ((A.compliance + B.compliance) / contact.factor + contact.layers);
    contact.max_penetration = kMaxPenetration * std::min(A.size, B.size);
    // The depth of a layer is its own compression.
    contact.is_bounded = contact.layers == 0 && is_static;
    contact.softening = contact.reversed ? B.softening : A.softening;
    contact.opposite = contact.reversed ? A.compliance : B.compliance;
    contact.law.friction = pair.friction;
    contact.law.damping = contact.share * pair.damping;
    contact.law.slip_velocity = pair.slip_velocity.value_or(
        kCreep * std::min(A.size, B.size) / std::max(kCreepTime, kCreepSteps * step));
    return contact;
  }
};

/// What the scenario says of contact, sorted.
struct Entries {
  std::vector<ContactPair> named, patterns;  // of patterns first those that hold before others

  explicit Entries(const Scenario& scenario) {
    for (const ContactPair& pair : scenario.contacts)
      (num_patterns(pair) == 0 ? named : patterns).push_back(pair);
    std::reverse(patterns.begin(), patterns.end());
    std::stable_sort(patterns.begin(), patterns.end(),
                     [](const ContactPair& p, const ContactPair& q) {
                       return num_patterns(p) < num_patterns(q);
                     });
    if (scenario.contacts.empty()) patterns.push_back({"*", "*", {}});
  }

 private:
  static int num_patterns(const ContactPair& pair) {
    return (is_pattern(pair.a) ? 1 : 0) + (is_pattern(pair.b) ? 1 : 0);
  }
};

std::vector<ContactPairs::Named> named_pairs(const Scenario& scenario, const Entries& entries,
                                             const std::vector<Side>& sides) {
  std::unordered_map<std::string_view, int> index;
  for (const Body& body : scenario.bodies)
    index.try_emplace(body.name, static_cast<int>(index.size()));
  std::vector<ContactPairs::Named> named;
  for (std::size_t entry = 0; entry < entries.named.size(); ++entry) {
    const ContactPair& pair = entries.named[entry];
    const int a = index.at(pair.a), b = index.at(pair.b);
    for (const int body : {a, b})
      if (!sides[static_cast<std::size_t>(body)].is_there)
        throw InputError(pair.where,
                         fmt::format("body `{}` has nothing to touch with: it needs a mesh and "
                                     "must not have collides = false",
                                     scenario.bodies[static_cast<std::size_t>(body)].name));
    named.push_back({a, b, entry});
  }
  return named;
}

std::vector<ContactPairs::Member> members(const Scenario& scenario, const Entries& entries,
                                          const std::vector<Side>& sides) {
  std::vector<ContactPairs::Member> result(sides.size());
  for (std::size_t b = 0; b < sides.size(); ++b) {
    if (!sides[b].is_there) continue;
    ContactPairs::Member& member = result[b];
    for (std::size_t p = 0; p < entries.patterns.size(); ++p) {
      const std::uint64_t bit = std::uint64_t{1} << p;
      if (fits(entries.patterns[p].a, scenario.bodies[b].name)) member.first |= bit;
      if (fits(entries.patterns[p].b, scenario.bodies[b].name)) member.second |= bit;
    }
    member.is_fixed = sides[b].is_fixed;
    member.is_tissue = sides[b].is_tissue;
    member.size = sides[b].size;
  }
  return result;
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
  model.contacts = {};
  if (!scenario.contact) return;
  const auto entries = std::make_shared<const Entries>(scenario);
  const auto maker = std::make_shared<const PairMaker>(scenario, model);
  model.contacts = {
      named_pairs(scenario, *entries, maker->sides),
      members(scenario, *entries, maker->sides),
      {[=](const ContactPairs::Named& named) {
         return maker->make(named.a, named.b, entries->named[named.entry]);
       },
       [=](int a, int b, std::size_t bit) { return maker->make(a, b, entries->patterns[bit]); }}};
}

double detection_margin(const Model& model) {
  constexpr double kMarginOfElement = 0.1;
  double least = std::numeric_limits<double>::infinity();
  for (const BodyModel& body : model.bodies)
    if (body.collider) least = std::min(least, body.collider->size);
  return std::isfinite(least) ? kMarginOfElement * least : 0;
}

}  // namespace articular::sim
