#include "sim/contact/pressed_area.hpp"

#include "sim/contact/contact_area.hpp"
#include "sim/contact/contact_pressure.hpp"

namespace articular::sim {

double area_above(const Model& model, const ContactResponse& response, ContactId contact, int body,
                  const std::vector<char>& selected, double threshold) {
  double sum = 0;
  for (const ContactPairState* pair_state : response.pair_states()) {
    if (pair_state->contact != contact) continue;
    const ContactSides side = sides_of(model, *pair_state);
    const auto& groups = side.triangles.groups;
    const double share = pair_state->pair.share;  // of the pressure too
    const double stiffness = pair_state->point_stiffness;
    Eigen::VectorXd phi;
    if (!(stiffness > 0)) phi = signed_pressures(model, *pair_state);
    for (const ContactPairState::Patch& entry : pair_state->patches()) {
      if (!is_selected(side, entry, body, selected)) continue;
      if (!carries(*pair_state, entry.triangle, groups)) continue;
      const Vec3 pressure = stiffness > 0 ? Vec3(stiffness * entry.patch.depth)
                                          : Vec3(phi(groups.col(entry.triangle)));
      sum += share * area_that_carries(entry.patch, pressure.array() / share - threshold);
    }
  }
  return sum;
}

}  // namespace articular::sim
