#include "sim/contact/contact_forecast.hpp"

#include <algorithm>
#include <cmath>

#include "sim/model/model.hpp"

namespace articular::sim {
namespace {

using Foreseen = ContactPairState::Foreseen;

bool is_foreseeable(const ContactPairState& pair_state) {
  return pair_state.pair.averaged && pair_state.drag.empty();
}

/// Whether the matrix takes a group for something else than it is.
bool is_taken_otherwise(const ContactPairState& pair_state, int group) {
  return pair_state.presses_in_matrix(group) != (pair_state.pressure[group] > 0);
}

}  // namespace

ContactForecast::ContactForecast(const Model& model)
    : model_(model),
      gradient_(model),
      held_(static_cast<std::size_t>(model.layout.num_unknown_blocks()), -1) {
  for (std::size_t h = 0; h < model.held_blocks.size(); ++h)
    held_[static_cast<std::size_t>(model.held_blocks[h].block)] = static_cast<int>(h);
}

void GroupChanges::clear() {
  stiffness.clear();
  begin.resize(1);
  block.clear();
  gradient.clear();
}

/// A_a ∇g_a, with the patches of the pair state at hand.
void ContactForecast::gather(const ContactPairState& pair_state, int group,
                             const Configuration& configuration) {
  const auto& groups = sides_of(model_, pair_state).triangles.groups;
  gradient_.gather(
      pair_state, patches_.of(group), configuration, [&](const ContactPairState::Patch& entry) {
        return patch_gradient(
            entry.patch,
            mean_depths(pair_state, entry, groups, corner_of_group(groups, entry.triangle, group)));
      });
}

/// @param pressure  that is then, less the one that the matrix has [Pa]
/// @param measure   A [m²]
void ContactForecast::note(double stiffness, double pressure, double measure) {
  changes_.stiffness.push_back(stiffness * measure);
  for (const int block : gradient_.blocks()) {
    changes_.block.push_back(block);
    Vec3 gradient = gradient_.at(block) / measure;
    if (const int held = held_[static_cast<std::size_t>(block)]; held >= 0)
      gradient = (model_.held_blocks[static_cast<std::size_t>(held)].free * gradient).eval();
    changes_.gradient.push_back(gradient);
    missed_.segment<3>(3 * block) += pressure * measure * gradient;
  }
  changes_.begin.push_back(static_cast<int>(changes_.block.size()));
}

const GroupChanges& ContactForecast::foresee(ContactResponse& response,
                                             const Configuration& configuration,
                                             const Eigen::VectorXd& correction) {
  changes_.clear();
  missed_.setZero(correction.size());
  for (ContactPairState* const pair_state : response.pair_states()) {
    if (!is_foreseeable(*pair_state) || pair_state->groups.empty()) continue;
    patches_.find(model_, *pair_state);
    pair_state->foreseen.resize(static_cast<std::size_t>(pair_state->pressure.size()));
    for (const int a : pair_state->groups) {
      gather(*pair_state, a, configuration);
      double way = 0;  // A δg
      for (const int block : gradient_.blocks())
        way += gradient_.at(block).dot(correction.segment<3>(3 * block));
      const double measure = pair_state->measure[a], k = pair_state->slope(a);
      const bool presses = pair_state->presses_after(a, way / measure);
      const double pressure = pair_state->signed_pressure(a) + k * way / measure;
      if (presses != pair_state->presses_in_matrix(a))
        note(presses ? k : -k, std::abs(pressure), measure);
      pair_state->foreseen[static_cast<std::size_t>(a)] =
          presses ? Foreseen::Presses : Foreseen::IsOpen;
      gradient_.clear();
    }
  }
  return changes_;
}

bool ContactForecast::is_made(const ContactResponse& response) {
  const auto states = response.pair_states();
  return std::any_of(states.begin(), states.end(), [](const ContactPairState* pair_state) {
    return std::any_of(pair_state->groups.begin(), pair_state->groups.end(),
                       [&](int a) { return is_taken_otherwise(*pair_state, a); });
  });
}

void ContactForecast::add_force(const ContactResponse& response, const Configuration& configuration,
                                Eigen::VectorXd& f) {
  for (const ContactPairState* const pair_state : response.pair_states()) {
    if (pair_state->foreseen.empty()) continue;
    patches_.find(model_, *pair_state);
    for (const int a : pair_state->groups) {
      if (!is_taken_otherwise(*pair_state, a)) continue;
      gather(*pair_state, a, configuration);
      const double p = pair_state->signed_pressure(a);
      for (const int block : gradient_.blocks())
        f.segment<3>(3 * block) +=
            (pair_state->presses_in_matrix(a) ? -p : p) * gradient_.at(block);
      gradient_.clear();
    }
  }
}

}  // namespace articular::sim
