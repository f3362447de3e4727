#include "sim/statics/contact_hooks.hpp"

#include <algorithm>

namespace articular::sim {

double margin_for(const Model& model, double stray) {
  constexpr double kMarginPerStray = 4;  // half of it would just do
  double margin = model.detection_margin;
  while (margin < kMarginPerStray * stray) margin *= 2;
  return margin;
}

ContactHooks contact_hooks(const Model& model, ContactSearch& search, Dynamics& dynamics,
                           double& margin, std::int64_t& rejected) {
  ContactHooks hooks;
  hooks.find = [&](const Configuration& where, double motion) {
    margin = std::max(margin, 2 * motion);
    search.find(where, margin);
    dynamics.set_candidates(search.candidates());
  };
  hooks.cover = [&, find = hooks.find](const Configuration& where, double motion) {
    if (search.motion_since(where) + motion > 0.5 * margin) find(where, motion);
  };
  hooks.covered = [&] {
    const double stray = search.motion_since(dynamics.now().configuration);
    const bool covered = stray <= 0.5 * margin;
    margin = std::min(margin_for(model, stray), model.trusted_motion);
    if (!covered) ++rejected;
    return covered;
  };
  return hooks;
}

}  // namespace articular::sim
