#include "sim/contact_response.hpp"

#include <algorithm>
#include <cmath>

namespace articular::sim {

ContactResponse::ContactResponse(const Model& model)
    : model_(model), of_contact_(model.contacts.size(), nullptr) {}

ContactDirection& ContactResponse::direction_of(const CandidateList& list) {
  ContactDirection*& known = of_contact_[static_cast<std::size_t>(list.contact)];
  if (known != nullptr) return *known;
  ContactDirection& direction = directions_.emplace_back();
  direction.contact = list.contact;
  const Eigen::Index num_sheets = std::ssize(sides_of(model_, direction).triangles.sheet_node);
  for (Eigen::VectorXd* values :
       {&direction.area, &direction.measure, &direction.depth, &direction.pressure})
    values->setZero(num_sheets);
  known = &direction;
  return direction;
}

void ContactResponse::clear(ContactDirection& direction) const {
  for (Eigen::VectorXd* values :
       {&direction.area, &direction.measure, &direction.depth, &direction.pressure})
    for (const int sheet : direction.sheets) (*values)[sheet] = 0;
  direction.sheets.clear();
  direction.drag.clear();
  direction.num_patches = 0;
}

void ContactResponse::evaluate(const Configuration& configuration,
                               std::span<const CandidateList> candidates) {
  near_.clear();
  for (const CandidateList& list : candidates) {
    ContactDirection& direction = direction_of(list);
    near_.push_back(&direction);
    clear(direction);
    find_patches(list, configuration, direction);
    find_pressures(configuration, direction);
  }
}

void ContactResponse::find_pressures(const Configuration& configuration,
                                     ContactDirection& direction) {
  ++evaluations_[Term::ContactForce];
  const auto c = static_cast<std::size_t>(direction.contact);
  const ContactModel& contact = model_.contacts[c];
  direction.model_stiffness = soft_ ? &contact.soft : &contact.stiffness;
  direction.stiffening = stiffening_.size() > 0 ? stiffening_[static_cast<Eigen::Index>(c)] : 1;
  direction.point_stiffness = contact.averaged ? 0 : direction.stiffness(0);
  for (const int sheet : direction.sheets) {
    direction.depth[sheet] /= direction.measure[sheet];
    direction.pressure[sheet] = direction.penalty(sheet);
  }
  if (!contact.law.acts()) return;
  const ContactSides side = sides_of(model_, direction);
  find_drag(contact.law, side.triangles, side.faces, configuration, direction);
  if (contact.law.friction > 0) ++evaluations_[Term::Friction];
  if (contact.law.damping > 0) ++evaluations_[Term::ContactDamping];
}

bool ContactResponse::augment() {
  bool any = false;
  for (ContactDirection* const near : near_) {
    ContactDirection& direction = *near;
    const ContactModel& contact = model_.contacts[static_cast<std::size_t>(direction.contact)];
    if (!contact.is_bounded || !contact.averaged) continue;
    const bool exceeds =
        std::any_of(direction.sheets.begin(), direction.sheets.end(), [&](int sheet) {
          return direction.pressure[sheet] > 0 && direction.depth[sheet] > contact.max_penetration;
        });
    if (!exceeds) continue;
    direction.multiplier = direction.pressure;
    any = true;
  }
  return any;
}

void ContactResponse::drop_multipliers() {
  for (ContactDirection& direction : directions_) direction.multiplier.resize(0);
}

const FlatTriangle& ContactResponse::face_now(const Configuration& configuration,
                                              const Collider& faces, int face) {
  const auto f = static_cast<std::size_t>(face);
  if (met_[f] != now_) {
    met_[f] = now_;
    faces_[f] = flat_triangle(corners_of(configuration, faces, face));
    faces_[f].rims = faces.rims[f];
    faces_[f].rim_height = faces.rim_height.col(face);
  }
  return faces_[f];
}

namespace {

/// A triangle's patches. Where faces stand oblique to it their weights differ, and beside rims the
/// depths: no face takes over from the next what an edge sweeps. Nor, in the tangent, at the corner
/// where such an edge meets an end.
void end_at_edges(std::span<ContactDirection::Patch> patches) {
  if (std::none_of(patches.begin(), patches.end(), [](const ContactDirection::Patch& entry) {
        return entry.patch.turning != 0 || entry.patch.nearest != ContactPatch::kFace ||
               has_end(entry.patch);
      }))
    return;
  for (ContactDirection::Patch& entry : patches)
    for (int k = 0; k < entry.patch.num_edges; ++k)
      entry.patch.edge[static_cast<std::size_t>(k)].is_end = true;
}

}  // namespace

/// Patches of a direction, and what they sum to at sheets: W, A and (in place of g) G.
void ContactResponse::find_patches(const CandidateList& list, const Configuration& configuration,
                                   ContactDirection& direction) {
  const ContactSides side = sides_of(model_, direction);
  direction.num_patches = 0;
  ++now_;
  if (faces_.size() < side.faces.face_area.size()) {
    faces_.resize(side.faces.face_area.size());
    met_.resize(side.faces.face_area.size(), 0);
  }
  const auto contact = static_cast<std::size_t>(direction.contact);
  const bool averaged = model_.contacts[contact].averaged;
  const std::span<const SamplePoint> samples = model_.contacts[contact].samples;
  DepthRange range = depth_range(side.triangles, side.faces, averaged);
  if (!allowances_.empty()) range.allowance = allowances_[contact];
  const std::vector<ContactCandidate>& pairs = list.pairs;
  for (std::size_t first = 0; first < pairs.size();) {  // they come sorted by triangle
    const int triangle = pairs[first].triangle;
    const FlatTriangle s = flat_triangle(corners_of(configuration, side.triangles, triangle));
    const double rest_area = side.triangles.face_area[static_cast<std::size_t>(triangle)];
    Vec3 covered = Vec3::Zero(), integrals = Vec3::Zero();
    const std::size_t first_patch = direction.num_patches;
    for (; first < pairs.size() && pairs[first].triangle == triangle; ++first) {
      const int face = pairs[first].face;
      range.reach = pairs[first].reach;
      const FlatTriangle& f = face_now(configuration, side.faces, face);
      for (int nearest = 0; nearest <= ContactPatch::kFace; ++nearest) {
        if (direction.num_patches == direction.stored.size()) direction.stored.emplace_back();
        ContactDirection::Patch& entry = direction.stored[direction.num_patches];
        if (!contact_patch(s, f, rest_area, range, entry.patch, samples, nearest)) continue;
        ++direction.num_patches;
        entry.triangle = triangle;
        entry.face = face;
        covered += nodal_areas(entry.patch);
        integrals += depth_integrals(entry.patch);
      }
    }
    Vec3 measure_slope = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
      if (!(covered[i] > 0)) continue;
      const int sheet = side.triangles.sheets(i, triangle);
      if (direction.measure[sheet] == 0) direction.sheets.push_back(sheet);
      const double measure = averaged ? std::sqrt(covered[i] * rest_area / 3) : covered[i];
      if (averaged) measure_slope[i] = 0.5 * measure / covered[i];
      direction.measure[sheet] += measure;
      direction.area[sheet] += covered[i];
      direction.depth[sheet] += integrals[i];
    }
    const std::span<ContactDirection::Patch> of_triangle(direction.stored.data() + first_patch,
                                                         direction.num_patches - first_patch);
    for (ContactDirection::Patch& entry : of_triangle) entry.measure_slope = measure_slope;
    end_at_edges(of_triangle);
  }
}

void ContactResponse::add_force(const Configuration& configuration, Eigen::VectorXd& f) {
  force_on_bodies_.assign(model_.bodies.size(), 0);
  for (const ContactDirection* direction : near_) {
    const ContactSides side = sides_of(model_, *direction);
    const auto& sheets = side.triangles.sheets;
    Vec3 on_triangles = Vec3::Zero();
    for (const ContactDirection::Patch& entry : direction->patches()) {
      if (!carries(*direction, entry.triangle, sheets)) continue;
      const Vec18 forces = forces_on_nodes(*direction, entry, sheets);
      const auto nodes = nodes_of(side.triangles, side.faces, entry.triangle, entry.face);
      for (std::size_t i = 0; i < 6; ++i)
        sim::add_force(configuration, *nodes[i],
                       forces.segment<3>(3 * static_cast<Eigen::Index>(i)), f);
      on_triangles += forces.segment<3>(0) + forces.segment<3>(3) + forces.segment<3>(6);
    }
    if (side.is_self()) continue;
    for (const int body : {side.triangle_body, side.face_body})
      force_on_bodies_[static_cast<std::size_t>(body)] += on_triangles.norm();
  }
}

bool ContactResponse::has_patches() const {
  return std::any_of(near_.begin(), near_.end(),
                     [](const ContactDirection* direction) { return direction->num_patches > 0; });
}

std::vector<double> ContactResponse::point_depths() const {
  std::vector<double> deepest(model_.contacts.size(), 0);
  for (const ContactDirection* direction : near_) {
    double& depth = deepest[static_cast<std::size_t>(direction->contact)];
    for (const ContactDirection::Patch& entry : direction->patches())
      depth = std::max(depth, entry.patch.depth_max);
  }
  return deepest;
}

double ContactResponse::largest_force() const {
  double largest = 0;
  for (const ContactDirection* direction : near_)
    for (const int sheet : direction->sheets)
      largest = std::max(largest, direction->pressure[sheet] * direction->area[sheet]);
  return largest;
}

void ContactResponse::add_damping_product(const Configuration& configuration,
                                          const Eigen::VectorXd& u, double scale,
                                          Eigen::VectorXd& f) const {
  for (const ContactDirection* direction : near_) {
    if (direction->drag.empty()) continue;
    const ContactSides side = sides_of(model_, *direction);
    add_drag_product(*direction, side.triangles, side.faces, configuration, u, scale, f);
  }
}

void ContactResponse::update_grips(const Configuration& configuration,
                                   const Eigen::VectorXd& change) {
  for (ContactDirection* const near : near_) {
    const ContactModel& contact = model_.contacts[static_cast<std::size_t>(near->contact)];
    if (!(contact.law.friction > 0)) continue;
    const ContactSides side = sides_of(model_, *near);
    sim::update_grips(contact.law, side.triangles, side.faces, configuration, change, *near);
  }
}

void ContactResponse::drop_grips() {
  for (ContactDirection& direction : directions_) direction.grip.resize(3, 0);
}

double ContactResponse::damping_power() const {
  double power = 0;
  for (const ContactDirection* direction : near_) power += drag_power(*direction);
  return power;
}

}  // namespace articular::sim
