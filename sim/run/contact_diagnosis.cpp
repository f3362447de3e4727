#include "sim/run/contact_diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "sim/model/near_contacts.hpp"
#include "sim/run/run.hpp"
#include "sim/step/overlap_resolution.hpp"
#include "sim/step/stepper.hpp"

namespace articular::sim {
namespace {

using TriedContacts = ContactTrial::Contacts;
using Outcome = ContactTrial::Outcome;

/// Wall time that is left.
class Deadline {
 public:
  explicit Deadline(double seconds)
      : end_(std::chrono::steady_clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}
  bool is_over() const { return Clock::now() > end_; }
  /// Asked within steps: they end by an Interruption.
  void watch(Stepper& stepper) const {
    stepper.set_watch([this](double, const NewtonIteration&) { return is_over(); });
    stepper.set_stop([this] { return is_over(); });
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point end_;
};

Model with_contacts(const Model& model, TriedContacts which, ContactId contact) {
  Model changed = model;
  changed.contacts = which == TriedContacts::None    ? ContactPairs{}
                     : which == TriedContacts::Alone ? model.contacts.only(contact)
                                                     : model.contacts.without(contact);
  changed.probes.clear();  // they number contacts
  return changed;
}

/// Pairs that may meet in a step.
std::vector<ContactId> near_pairs(const Model& model, const Configuration& now) {
  std::vector<collision::Aabb> boxes(model.bodies.size());
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    if (!model.bodies[b].collider) continue;
    for (const NodeRef& node : model.bodies[b].collider->nodes)
      boxes[b].include(now.position(node));
    boxes[b].inflate(0.5 * model.trusted_motion);
  }
  return NearContacts().find(model.contacts, boxes);
}

class Diagnosis {
 public:
  Diagnosis(const Scenario& scenario, const Model& model, const DiagnosisOptions& options)
      : scenario_(scenario),
        model_(model),
        options_(options),
        settings_(step_settings(scenario)),
        kinks_(kink_times(model, scenario.duration)) {}

  ContactDiagnosis make() {
    if (!fails()) return result_;
    const std::vector<ContactId> pairs = near_pairs(model_, failed_from_);
    const double seconds = options_.seconds / static_cast<double>(1 + 2 * pairs.size());
    try_with(TriedContacts::None, -1, seconds);
    for (const TriedContacts which : {TriedContacts::Alone, TriedContacts::AllBut})
      for (const ContactId pair : pairs) try_with(which, pair, seconds);
    result_.culprits = culprits();
    return result_;
  }

 private:
  void tell(const std::string& what) const {
    if (options_.progress) options_.progress(what);
  }

  /// The next time at which steps of a run end too.
  double target(double t) const {
    const double interval = scenario_.output.interval;
    double next = std::min(scenario_.duration,
                           interval * (std::floor(t / interval * (1 + 1e-12) + 1e-9) + 1));
    const auto kink = std::upper_bound(kinks_.begin(), kinks_.end(), t * (1 + 1e-12));
    return kink == kinks_.end() ? next : std::min(next, *kink);
  }

  bool fails() {
    tell("runs until a step fails");
    const Deadline deadline(options_.seconds);
    Stepper stepper(model_, settings_);
    deadline.watch(stepper);
    State state = stepper.initial();
    try {
      resolve_overlaps(scenario_, model_, state.y,
                       [&](double, const NewtonIteration&) { return deadline.is_over(); });
      stepper.restart(state);
      while (state.t < scenario_.duration && !deadline.is_over()) {
        before_ = state;
        began_ = true;
        stepper.step(state, target(state.t));
      }
    } catch (const Interruption&) {
      result_.reached = state.t;
      return false;
    } catch (const SimulationError& error) {
      result_.reached = state.t;
      result_.why = error.what();
      read_state(model_, before_.y.data(), before_.t, failed_from_);
      return began_;
    }
    result_.reached = state.t;
    result_.ended = state.t >= scenario_.duration;
    return false;
  }

  std::string words(TriedContacts which, ContactId contact) const {
    if (which == TriedContacts::None) return "without contact";
    const ContactModel pair = model_.contacts[contact];
    return fmt::format("{} `{}` and `{}`",
                       which == TriedContacts::Alone ? "with contact of" : "without",
                       model_.bodies[static_cast<std::size_t>(pair.a)].name,
                       model_.bodies[static_cast<std::size_t>(pair.b)].name);
  }

  void try_with(TriedContacts which, ContactId contact, double seconds) {
    tell(words(which, contact));
    ContactTrial trial{which, contact, Outcome::Taken, ""};
    const Deadline deadline(seconds);
    const Model changed = with_contacts(model_, which, contact);
    Stepper stepper(changed, settings_);
    deadline.watch(stepper);
    State state = before_;
    const double end = std::min(state.t + settings_.step, target(state.t));
    try {
      stepper.restart(state);
      while (state.t < end && !deadline.is_over()) stepper.step(state, end);
      if (state.t < end) trial.outcome = Outcome::OutOfTime;
    } catch (const Interruption&) {
      trial.outcome = Outcome::OutOfTime;
    } catch (const SimulationError& error) {
      trial.outcome = Outcome::Failed;
      trial.why = error.what();
    }
    result_.trials.push_back(trial);
  }

  std::vector<ContactId> culprits() const {
    const auto those = [&](TriedContacts which, Outcome outcome) {
      std::vector<ContactId> found;
      for (const ContactTrial& trial : result_.trials)
        if (trial.contacts == which && trial.outcome == outcome) found.push_back(trial.contact);
      return found;
    };
    std::vector<ContactId> needed = those(TriedContacts::AllBut, Outcome::Taken);
    if (!needed.empty() || result_.trials.front().outcome != Outcome::Taken) return needed;
    return those(TriedContacts::Alone, Outcome::Failed);
  }

  const Scenario& scenario_;
  const Model& model_;
  const DiagnosisOptions& options_;
  const StepSettings settings_;
  std::vector<double> kinks_;
  State before_;        // the step that failed
  bool began_ = false;  // it was not the bodies' overlap that could not be resolved
  Configuration failed_from_;
  ContactDiagnosis result_;
};

}  // namespace

ContactDiagnosis diagnose_contact(const Scenario& scenario, const Model& model,
                                  const DiagnosisOptions& options) {
  return Diagnosis(scenario, model, options).make();
}

}  // namespace articular::sim
