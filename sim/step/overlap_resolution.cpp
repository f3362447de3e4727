#include "sim/step/overlap_resolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/base/place_text.hpp"
#include "sim/build/build_model.hpp"
#include "sim/contact/initial_overlap.hpp"
#include "sim/model/tied_bodies.hpp"
#include "sim/statics/contact_hooks.hpp"
#include "sim/statics/pseudo_time.hpp"

namespace articular::sim {
namespace {

/// Of the allowance, in elements at the surface.
constexpr double kStepOfElement = 0.25;
constexpr int kMostHalvings = 3;
constexpr double kLastRoundOff = 1e-9;
/// Of an element: surfaces that lie flush are no deeper in each other.
constexpr double kFlush = 1e-6;
/// A solution first moves things no farther than so many times the deepest overlap: farther ones
/// may go astray where much may touch.
constexpr double kReachOfOverlap = 4;
/// Solutions in pseudo-time for one step.
constexpr int kMostEquilibria = 50;
/// Of the largest force, what is left unbalanced where tissue is held between bodies. In time it
/// sets things in motion. Statics balance it with the loads, without which what only contact holds
/// has hardly a stiffness, so that the last bit takes most iterations.
double most_unbalanced(const Scenario& scenario) {
  return scenario.analysis == Scenario::Analysis::Static ? 1e-2 : 1e-3;
}

/// Without velocities and activation: dampers and muscles rest.
Eigen::VectorXd at_rest(const Model& model, const Eigen::VectorXd& y) {
  Eigen::VectorXd resting = y;
  resting.tail(y.size() - model.layout.velocities()).setZero();
  return resting;
}

std::string names(const Model& model, const ContactModel& contact) {
  return fmt::format("`{}` and `{}`", model.bodies[static_cast<std::size_t>(contact.a)].name,
                     model.bodies[static_cast<std::size_t>(contact.b)].name);
}

/// Of the elements at both surfaces [m].
double least_size(const Model& model, const ContactModel& contact) {
  const auto size = [&](int body) {
    return model.bodies[static_cast<std::size_t>(body)].collider->size;
  };
  return std::min(size(contact.a), size(contact.b));
}

/// Surfaces that lie flush are no deeper in each other [m].
double flush_depth(const Model& model, const ContactModel& contact) {
  return kFlush * least_size(model, contact);
}

/// A deeper overlap is set apart [m]. Tissue and layers give way by as much as contact may take.
/// Two rigid bodies don't: a hundredth of an element of bone holds enough energy to throw a tool
/// off.
double kept_depth(const Model& model, const ContactModel& contact) {
  const auto is_tissue = [&](int body) {
    return model.bodies[static_cast<std::size_t>(body)].tissue >= 0;
  };
  const bool gives_way = is_tissue(contact.a) || is_tissue(contact.b) || contact.layers > 0;
  return gives_way ? contact.max_penetration : flush_depth(model, contact);
}

/// What lies so deep in another body that contact can't tell the way out is no start.
/// @param seen  depths that contact finds a face for
void refuse_lost_bodies(const Model& model, const ContactDepths& seen) {
  for (const InitialOverlap& overlap : initial_overlaps(model)) {
    const ContactModel contact = model.contacts[overlap.contact];
    if (overlap.depth <= contact.max_penetration || are_tied(model, contact.a, contact.b)) continue;
    if (seen.of(overlap.contact) > 0) continue;
    throw SimulationError(
        fmt::format("{} overlap at the start by {:.3g} mm, at {}, and "
                    "contact can't tell the way out: move one of them",
                    names(model, contact), 1e3 * overlap.depth, place_text(overlap.place)));
  }
}

class OverlapResolver {
 public:
  /// @param model  of the scenario, perhaps with_pointwise_contact()
  OverlapResolver(const Scenario& scenario, const Model& model, const IterationWatch& watch = {})
      : model_(model),
        dynamics_(model),
        search_(model, step_settings(scenario)),
        equilibrium_(model, dynamics_, step_settings(scenario)),
        margin_(model.detection_margin),
        most_unbalanced_(most_unbalanced(scenario)) {
    equilibrium_.set_watch(watch);
    hooks_ = contact_hooks(model, search_, dynamics_, margin_, rejected_);
  }

  std::vector<OverlapAtStart> at_start(const Eigen::VectorXd& y) {
    const ContactDepths depth = depths(at_rest(model_, y));
    // Where depths are averaged, facets of a round surface may cut into another and carry nothing.
    refuse_lost_bodies(model_, dynamics_.now().contact.point_depths());
    std::vector<OverlapAtStart> overlaps;
    for (const auto& [id, deepest] : depth.all())
      if (const ContactModel contact = model_.contacts[id]; deepest > flush_depth(model_, contact))
        overlaps.push_back({id, deepest, deepest > kept_depth(model_, contact)});
    return overlaps;
  }

  /// Deeper than they may be.
  std::vector<ResolvedOverlap> overlaps(const Eigen::VectorXd& y) {
    std::vector<ResolvedOverlap> overlaps;
    for (const OverlapAtStart& overlap : at_start(y))
      if (overlap.is_set_apart) overlaps.push_back({overlap.contact, overlap.depth, 0});
    return overlaps;
  }

  OverlapResolution resolve(Eigen::VectorXd& y) {
    resolution_.overlaps = overlaps(y);
    Eigen::VectorXd moving = at_rest(model_, y);
    const Eigen::VectorXd start = moving;
    double done = 0, step = 1.0 / num_steps();
    for (int halvings = 0; done < 1;) {
      const double target = done + step > 1 - kLastRoundOff ? 1 : done + step;
      if (relax(1 - target, moving)) {
        done = target;
      } else if (++halvings > kMostHalvings) {
        fail(fmt::format("they could be pushed apart by no more than {:.3g} mm",
                         1e3 * done * deepest().before));
      } else {
        step *= 0.5;
      }
    }
    finish(start, moving);
    y.head(model_.layout.velocities()) = moving.head(model_.layout.velocities());
    return resolution_;
  }

 private:
  Conditions conditions() const {
    return {.unloaded = true, .contact = {.allowances = &allowances_}};
  }

  ContactDepths depths(const Eigen::VectorXd& y) {
    allowances_ = {};
    look(y, 0);
    ContactDepths depths;
    for (const ContactSummary& contact : dynamics_.contacts())
      depths.add(contact.contact, contact.max_point_depth);
    return depths;
  }

  double num_steps() const {
    double count = 1;
    for (const ResolvedOverlap& overlap : resolution_.overlaps) {
      const ContactModel contact = model_.contacts[overlap.contact];
      const double step = kStepOfElement * least_size(model_, contact);
      count = std::max(count, std::ceil(overlap.before / step));
    }
    return count;
  }

  /// Moves bodies on from rest in pseudo-time, each solution by no more than an element and at
  /// first not far beyond the overlaps, until what is deeper than this part of them is gone, or
  /// held by bodies that can't give way.
  bool relax(double allowed, Eigen::VectorXd& y) {
    allowances_ = {};
    for (const ResolvedOverlap& overlap : resolution_.overlaps)
      allowances_.add(overlap.contact, allowed * overlap.before);
    const auto approach = [&](double reach) {
      return approach_in_pseudo_time(reach, kMostEquilibria,
                                     [&](double motion) { return move_on(motion, y); });
    };
    const double near = kReachOfOverlap * deepest().before;
    // Some have to go farther: tissue that is prestressed, a body that has to turn.
    return (near < model_.trusted_motion && approach(near)) || approach(model_.trusted_motion);
  }

  PseudoStep move_on(double motion, Eigen::VectorXd& y) {
    look(y, motion);
    if (is_settled()) return PseudoStep::Arrived;
    Eigen::VectorXd trial = y;
    const bool solved =
        equilibrium_.solve(trial, 0, equilibrium_.largest_acceleration() / motion, conditions());
    ++resolution_.solutions;
    resolution_.iterations += static_cast<int>(equilibrium_.iterations().size());
    if (solved) dynamics_.evaluate(trial.data(), 0, conditions());
    if (!solved || !hooks_.covered()) return PseudoStep::Failed;
    y = trial;
    return PseudoStep::Moved;
  }

  bool is_settled() const {
    const std::vector<ContactSummary> contacts = dynamics_.contacts();
    const bool apart =
        std::all_of(contacts.begin(), contacts.end(), [this](const ContactSummary& contact) {
          return contact.max_point_depth <= kept_depth(model_, model_.contacts[contact.contact]);
        });
    return apart || equilibrium_.is_balanced(most_unbalanced_);
  }

  /// Finds contacts at y, for things that will move so far [m], and evaluates there.
  void look(const Eigen::VectorXd& y, double motion) {
    read_state(model_, y.data(), 0, where_);
    hooks_.find(where_, motion);
    dynamics_.evaluate(y.data(), 0, conditions());
  }

  void finish(const Eigen::VectorXd& start, const Eigen::VectorXd& y) {
    const ContactDepths depth = depths(y);
    for (ResolvedOverlap& overlap : resolution_.overlaps) overlap.after = depth.of(overlap.contact);
    Configuration before;
    read_state(model_, start.data(), 0, before);
    refuse_turned_elements(before);
    for (const BodyModel& body : model_.bodies)
      if (body.collider)
        for (const NodeRef& node : body.collider->nodes)
          resolution_.largest_motion = std::max(
              resolution_.largest_motion,
              (dynamics_.now().configuration.position(node) - before.position(node)).norm());
  }

  /// A surface that has been turned inside out touches nothing: it only looks as if it were apart.
  void refuse_turned_elements(const Configuration& before) const {
    for (const Tissue& tissue : model_.tissues) {
      Eigen::Index element = 0;
      const auto least = [&](const Configuration& configuration) {
        Positions x;
        positions_of(configuration, tissue.nodes, x);
        return tissue.elements.volume_ratio(x).minCoeff(&element);
      };
      if (least(before) > 0 && !(least(dynamics_.now().configuration) > 0))
        fail(fmt::format("pushing them apart would turn tetrahedron {} of `{}` inside out", element,
                         model_.bodies[static_cast<std::size_t>(tissue.body)].name));
    }
  }

  const ResolvedOverlap& deepest() const {
    return *std::max_element(
        resolution_.overlaps.begin(), resolution_.overlaps.end(),
        [](const ResolvedOverlap& p, const ResolvedOverlap& q) { return p.before < q.before; });
  }

  [[noreturn]] void fail(const std::string& how) const {
    throw SimulationError(fmt::format(
        "{} overlap at the start by {:.3g} mm, and {}: move one of them",
        names(model_, model_.contacts[deepest().contact]), 1e3 * deepest().before, how));
  }

  const Model& model_;
  Dynamics dynamics_;
  ContactSearch search_;
  Equilibrium equilibrium_;
  ContactHooks hooks_;
  Configuration where_;  // contacts are looked for
  double margin_, most_unbalanced_;
  std::int64_t rejected_ = 0;
  ContactDepths allowances_;
  OverlapResolution resolution_;
};

}  // namespace

std::vector<OverlapAtStart> overlaps_at_start(const Scenario& scenario, const Model& model,
                                              const Eigen::VectorXd& y) {
  if (model.contacts.empty()) return {};
  return OverlapResolver(scenario, model).at_start(y);
}

OverlapResolution resolve_overlaps(const Scenario& scenario, const Model& model, Eigen::VectorXd& y,
                                   const IterationWatch& watch) {
  if (model.contacts.empty() || y.size() == 0) return {};
  OverlapResolver resolver(scenario, model, watch);
  if (resolver.overlaps(y).empty()) return {};
  if (!model.contacts.any([](const ContactModel& contact) { return contact.averaged; }))
    return resolver.resolve(y);
  // Soft pointwise contact gets bodies out of each other more easily, and edges and corners too.
  const Model pointwise = with_pointwise_contact(model, scenario);
  return OverlapResolver(scenario, pointwise, watch).resolve(y);
}

}  // namespace articular::sim
