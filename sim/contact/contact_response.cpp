#include "sim/contact/contact_response.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace articular::sim {

double ContactDepths::of(ContactId contact) const {
  const auto found =
      std::lower_bound(depths_.begin(), depths_.end(), contact,
                       [](const auto& entry, ContactId id) { return entry.first < id; });
  return found != depths_.end() && found->first == contact ? found->second : 0;
}

ContactResponse::ContactResponse(const Model& model)
    : model_(model), met_(static_cast<std::size_t>(model.pool->num_threads())) {}

ContactPairState& ContactResponse::pair_state_of(const CandidateList& list) {
  ContactPairState*& known = of_contact_[list.contact];
  if (known != nullptr) return *known;
  ContactPairState& pair_state = pair_states_.emplace_back();
  pair_state.contact = list.contact;
  pair_state.pair = model_.contacts[list.contact];
  const Collider& nonmortar = sides_of(model_, pair_state).triangles;
  const Eigen::Index num_groups = std::ssize(nonmortar.group_node);
  pair_state.firm_stiffness = stiffness_at_groups(pair_state.pair, nonmortar, false);
  pair_state.soft_stiffness = stiffness_at_groups(pair_state.pair, nonmortar, true);
  for (Eigen::VectorXd* values :
       {&pair_state.area, &pair_state.measure, &pair_state.depth, &pair_state.pressure})
    values->setZero(num_groups);
  if (pair_state.pair.stiffens()) pair_state.on_layers.resize(static_cast<std::size_t>(num_groups));
  known = &pair_state;
  return pair_state;
}

void ContactResponse::clear(ContactPairState& pair_state) const {
  for (Eigen::VectorXd* values :
       {&pair_state.area, &pair_state.measure, &pair_state.depth, &pair_state.pressure})
    for (const int group : pair_state.groups) (*values)[group] = 0;
  if (!pair_state.on_layers.empty())
    for (const int group : pair_state.groups)
      pair_state.on_layers[static_cast<std::size_t>(group)] = {};
  pair_state.groups.clear();
  pair_state.drag.clear();
  pair_state.num_patches = 0;
}

namespace {

const FlatTriangle& face_now(const Configuration& configuration, const Collider& faces, int face,
                             MetFaces& met) {
  const auto f = static_cast<std::size_t>(face);
  FlatTriangle& triangle = met.face[f];
  if (std::exchange(met.met[f], met.now) != met.now) {
    triangle = flat_triangle(corners_of(configuration, faces, face));
    triangle.rims = faces.rims[f];
    triangle.rim_height = met.steepness * faces.rim_height.col(face);
  }
  return triangle;
}

/// Of depths beside a rim. Where surfaces give way by their elements they are as shallow as others.
/// A layer is pressed by a good part of its thickness: what came in through the face would count as
/// beside it in a strip that wide, and two blocks of the same outline would lose half of their
/// force. So there depths grow faster from the rim on, and the strip is a thirtieth of that.
double steepness_beside_rims(const ContactModel& contact) {
  constexpr double kOnLayers = 30;
  return contact.layers > 0 ? kOnLayers : 1;
}

/// Whether a face's neighbour of the same group stands oblique to the triangle, and so has not the
/// weight of one that faces it, or none.
bool meets_oblique(const FlatTriangle& s, const Configuration& configuration, const Collider& faces,
                   int face, MetFaces& met) {
  const auto across = faces.across.col(face);
  return std::any_of(across.begin(), across.end(), [&](int other) {
    return other >= 0 &&
           -s.normal.dot(face_now(configuration, faces, other, met).normal) < kFacingFull;
  });
}

/// A triangle's patches. Where faces stand oblique to it their weights differ, and beside rims the
/// depths: no face takes over from the next what an edge sweeps. Nor, in the tangent, at the corner
/// where such an edge meets an end. Where depths begin to count the sum is zero all along the edge.
void end_at_edges(std::span<ContactPairState::Patch> patches, bool meet_oblique) {
  if (!meet_oblique &&
      std::none_of(patches.begin(), patches.end(), [](const ContactPairState::Patch& entry) {
        return entry.patch.turning != 0 || is_beside_rim(entry.patch) || has_end(entry.patch);
      }))
    return;
  for (ContactPairState::Patch& entry : patches)
    for (int k = 0; k < entry.patch.num_edges; ++k) {
      PatchEdge& edge = entry.patch.edge[static_cast<std::size_t>(k)];
      edge.is_end = edge.kind != PatchEdge::Kind::OpenDepth;
    }
}

/// Asks for the memory of the next patch before it is written. There are thousands, of a kilobyte
/// and a half each, more than the caches near a processor hold: to wait for it took a third of the
/// time of contact's forces (sim/RESULTS.md).
void expect_another(const ContactPairState& pair_state) {
  constexpr std::size_t kLine = 64;
  if (pair_state.num_patches == pair_state.stored.size()) return;
  const auto* memory = reinterpret_cast<const char*>(&pair_state.stored[pair_state.num_patches]);
  for (std::size_t at = 0; at < sizeof(ContactPairState::Patch); at += kLine)
    __builtin_prefetch(memory + at, 1);
}

/// Patches of a contact pair, and what they sum to at groups: W and (in place of g) G.
void find_patches(const Model& model, const CandidateList& list, const Configuration& configuration,
                  double allowance, MetFaces& met, ContactPairState& pair_state) {
  const ContactSides side = sides_of(model, pair_state);
  ++met.now;
  met.steepness = steepness_beside_rims(pair_state.pair);
  if (met.face.size() < side.faces.face_area.size()) {
    met.face.resize(side.faces.face_area.size());
    met.met.resize(side.faces.face_area.size(), 0);
  }
  DepthRange range = depth_range(side.triangles, side.faces, pair_state.pair.averaged);
  range.allowance = allowance;
  const std::vector<ContactCandidate>& pairs = list.pairs;
  for (std::size_t first = 0; first < pairs.size();) {  // they come sorted by triangle
    const int triangle = pairs[first].triangle;
    const FlatTriangle s = flat_triangle(corners_of(configuration, side.triangles, triangle));
    const double rest_area = side.triangles.face_area[static_cast<std::size_t>(triangle)];
    Vec3 covered = Vec3::Zero(), integrals = Vec3::Zero();
    const std::size_t first_patch = pair_state.num_patches;
    bool meet_oblique = false;
    for (; first < pairs.size() && pairs[first].triangle == triangle; ++first) {
      const int face = pairs[first].face;
      range.reach = pairs[first].reach;
      const FlatTriangle& f = face_now(configuration, side.faces, face, met);
      const std::optional<FacingPair> facing = facing_pair(s, f, range);
      if (!facing) continue;
      meet_oblique = meet_oblique || meets_oblique(s, configuration, side.faces, face, met);
      for (int nearest = 0; nearest < ContactPatch::kParts; ++nearest) {
        if (pair_state.num_patches == pair_state.stored.size()) pair_state.stored.emplace_back();
        ContactPairState::Patch& entry = pair_state.stored[pair_state.num_patches];
        if (!contact_patch(*facing, s, f, rest_area, range, nearest, entry.patch)) continue;
        ++pair_state.num_patches;
        expect_another(pair_state);
        entry.triangle = triangle;
        entry.face = face;
        covered += nodal_areas(entry.patch);
        integrals += depth_integrals(entry.patch);
      }
    }
    for (int i = 0; i < 3; ++i) {
      if (!(covered[i] > 0)) continue;
      const int group = side.triangles.groups(i, triangle);
      if (pair_state.area[group] == 0) pair_state.groups.push_back(group);
      pair_state.area[group] += covered[i];
      pair_state.depth[group] += integrals[i];
    }
    end_at_edges({pair_state.stored.data() + first_patch, pair_state.num_patches - first_patch},
                 meet_oblique);
  }
}

}  // namespace

void ContactResponse::evaluate(const Configuration& configuration,
                               std::span<const CandidateList> candidates,
                               const ContactConditions& conditions) {
  near_.clear();
  for (const CandidateList& list : candidates) near_.push_back(&pair_state_of(list));
  model_.pool->run(static_cast<int>(candidates.size()), [&](int k, int worker) {
    const CandidateList& list = candidates[static_cast<std::size_t>(k)];
    ContactPairState& pair_state = *near_[static_cast<std::size_t>(k)];
    clear(pair_state);
    const double allowance =
        conditions.allowances == nullptr ? 0 : conditions.allowances->of(list.contact);
    find_patches(model_, list, configuration, allowance, met_[static_cast<std::size_t>(worker)],
                 pair_state);
    find_pressures(configuration, conditions.soft, pair_state);
    find_forces(sides_of(model_, pair_state).triangles.groups, pair_state);
  });
  for (const ContactPairState* pair_state : near_) count(pair_state->pair);
}

void ContactResponse::count(const ContactModel& contact) {
  ++evaluations_[Term::ContactForce];
  if (contact.law.friction > 0) ++evaluations_[Term::Friction];
  if (contact.law.damping > 0) ++evaluations_[Term::ContactDamping];
}

void ContactResponse::find_pressures(const Configuration& configuration, bool soft,
                                     ContactPairState& pair_state) const {
  const ContactModel& contact = pair_state.pair;
  pair_state.is_soft = soft;
  pair_state.point_stiffness = contact.averaged ? 0 : pair_state.stiffness(0);
  const ContactSides side = sides_of(model_, pair_state);
  for (const int group : pair_state.groups) {
    const double area = pair_state.area[group];
    double& measure = pair_state.measure[group];
    measure = contact.averaged ? std::sqrt(area * side.triangles.group_area[group]) : area;
    pair_state.depth[group] /= measure;
    if (!pair_state.on_layers.empty())
      pair_state.on_layers[static_cast<std::size_t>(group)] =
          pressed(layers_of(contact, pair_state.stiffness(group)), pair_state.depth[group]);
    pair_state.pressure[group] = pair_state.penalty(group);
  }
  if (contact.law.acts())
    find_drag(contact.law, side.triangles, side.faces, configuration, pair_state);
}

bool ContactResponse::augment() {
  bool any = false;
  for (ContactPairState* const near : near_) {
    ContactPairState& pair_state = *near;
    const ContactModel& contact = pair_state.pair;
    if (!contact.is_bounded) continue;
    const bool exceeds =
        std::any_of(pair_state.groups.begin(), pair_state.groups.end(), [&](int group) {
          return pair_state.pressure[group] > 0 &&
                 pair_state.depth[group] > contact.max_penetration;
        });
    if (!exceeds) continue;
    pair_state.multiplier = pair_state.pressure;
    any = true;
  }
  return any;
}

void ContactResponse::drop_multipliers() {
  for (ContactPairState& pair_state : pair_states_) pair_state.multiplier.resize(0);
}

void ContactResponse::add_force(const Configuration& configuration, Eigen::VectorXd& f) {
  force_on_bodies_.assign(model_.bodies.size(), 0);
  for (const ContactPairState* pair_state : near_) {
    Vec3 on_triangles = Vec3::Zero();
    const auto add = [&](const auto& nodes, const Vec18& forces) {
      for (std::size_t i = 0; i < nodes.size(); ++i)
        sim::add_force(configuration, *nodes[i],
                       forces.segment<3>(3 * static_cast<Eigen::Index>(i)), f);
      on_triangles += forces.segment<3>(0) + forces.segment<3>(3) + forces.segment<3>(6);
    };
    for_each_patch_that_carries(model_, *pair_state, add);
    const ContactSides side = sides_of(model_, *pair_state);
    if (side.is_self()) continue;
    for (const int body : {side.triangle_body, side.face_body})
      force_on_bodies_[static_cast<std::size_t>(body)] += on_triangles.norm();
  }
}

bool ContactResponse::has_patches() const {
  return std::any_of(near_.begin(), near_.end(), [](const ContactPairState* pair_state) {
    return pair_state->num_patches > 0;
  });
}

ContactDepths ContactResponse::point_depths() const {
  ContactDepths deepest;
  for (const ContactPairState* pair_state : near_) {
    double depth = 0;
    for (const ContactPairState::Patch& entry : pair_state->patches())
      depth = std::max(depth, entry.patch.depth_max);
    deepest.add(pair_state->contact, depth);
  }
  return deepest;
}

ContactDepths ContactResponse::node_depths() const {
  ContactDepths deepest;
  for (const ContactPairState* pair_state : near_) {
    double depth = 0;
    for (const int group : pair_state->groups)
      if (pair_state->pressure[group] > 0) depth = std::max(depth, pair_state->depth[group]);
    deepest.add(pair_state->contact, depth);
  }
  return deepest;
}

double ContactResponse::stored_energy() const {
  double energy = 0;
  for (const ContactPairState* pair_state : near_)
    energy += sim::stored_energy(*pair_state, sides_of(model_, *pair_state).triangles.groups);
  return energy;
}

double ContactResponse::largest_force() const {
  double largest = 0;
  for (const ContactPairState* pair_state : near_)
    for (const int group : pair_state->groups)
      largest = std::max(largest, pair_state->pressure[group] * pair_state->area[group]);
  return largest;
}

void ContactResponse::add_damping_product(const Configuration& configuration,
                                          const Eigen::VectorXd& u, double scale,
                                          Eigen::VectorXd& f) const {
  for (const ContactPairState* pair_state : near_) {
    if (pair_state->drag.empty()) continue;
    const ContactSides side = sides_of(model_, *pair_state);
    add_drag_product(*pair_state, side.triangles, side.faces, configuration, u, scale, f);
  }
}

void ContactResponse::update_friction_duals(const Configuration& configuration,
                                            const Eigen::VectorXd& change) {
  for (ContactPairState* const near : near_) {
    const ContactModel& contact = near->pair;
    if (!(contact.law.friction > 0)) continue;
    const ContactSides side = sides_of(model_, *near);
    sim::update_friction_duals(contact.law, side.triangles, side.faces, configuration, change,
                               *near);
  }
}

void ContactResponse::drop_friction_duals() {
  for (ContactPairState& pair_state : pair_states_) pair_state.friction_dual.resize(3, 0);
}

void ContactResponse::forget_foreseen() {
  for (ContactPairState& pair_state : pair_states_) pair_state.foreseen.clear();
}

void ContactResponse::forget() {
  near_.clear();
  of_contact_.clear();
  pair_states_.clear();
}

double ContactResponse::damping_power() const {
  double power = 0;
  for (const ContactPairState* pair_state : near_) power += drag_power(*pair_state);
  return power;
}

}  // namespace articular::sim
