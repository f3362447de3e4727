#include "tools/error_bars/coarser_runs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/build/contact_model.hpp"
#include "sim/scenario/name_pattern.hpp"
#include "sim/statics/equilibrium.hpp"

namespace articular::tools {
namespace {

using Scheme = sim::Integrator::Scheme;

constexpr const char* kRigidPairs = "two rigid bodies press each other with a fixed stiffness";

bool is_static(const sim::Scenario& scenario) {
  return scenario.analysis == sim::Scenario::Analysis::Static;
}

std::string seconds(const char* key, double value) {
  return fmt::format("{}=\"{} s\"", key, value);
}

int order_of(Scheme scheme) {
  switch (scheme) {
    case Scheme::TrBdf2:
      return 2;
    case Scheme::Dirk3:
      return 3;
    case Scheme::ImplicitEuler:
    case Scheme::Explicit:
      break;
  }
  return 1;
}

/// Whether two bodies that are no tissue, and not both fixed, can touch.
bool has_rigid_pair(const sim::Scenario& scenario) {
  std::vector<const sim::Body*> bodies;  // rigid ones first
  for (const sim::Body::Kind kind : {sim::Body::Kind::Rigid, sim::Body::Kind::Fixed})
    for (const sim::Body& body : scenario.bodies)
      if (body.kind == kind && can_touch(scenario, body)) bodies.push_back(&body);
  const auto is_pair = [](const sim::Body& a, const std::string& of_a, const sim::Body& b,
                          const std::string& of_b) {
    return (sim::fits(of_a, a.name) && sim::fits(of_b, b.name)) ||
           (sim::fits(of_b, a.name) && sim::fits(of_a, b.name));
  };
  std::vector<sim::ContactPair> pairs = scenario.contacts;
  if (pairs.empty()) pairs.push_back({"*", "*", {}});
  for (const sim::ContactPair& pair : pairs)
    for (std::size_t i = 0; i < bodies.size() && bodies[i]->kind == sim::Body::Kind::Rigid; ++i)
      for (const sim::Body* const other : bodies)
        if (other != bodies[i] && is_pair(*bodies[i], pair.a, *other, pair.b)) return true;
  return false;
}

CoarserRun longer_steps(const sim::Scenario& scenario, double factor) {
  CoarserRun run;
  run.name = fmt::format("step {} times", factor);
  const double step = std::min(factor * scenario.integrator.step, scenario.duration);
  run.overrides = {seconds("integrator.step", step),
                   seconds("output.interval", factor * scenario.output.interval)};
  if (scenario.output.checkpoint_interval)
    run.overrides.push_back(
        seconds("output.checkpoint_interval", factor * *scenario.output.checkpoint_interval));
  return run;
}

}  // namespace

Direction coarser_steps(const sim::Scenario& scenario) {
  Direction steps{"step"};
  if (!is_static(scenario) && scenario.integrator.scheme == Scheme::Explicit) {
    steps.remark = "the scheme chooses its steps: its tolerance is varied";
    for (const double factor : {10.0, 100.0})
      steps.runs.push_back({fmt::format("tolerance of steps {} times", factor),
                            looser_tolerance(scenario.integrator, factor), factor});
    return steps;
  }
  if (is_static(scenario))
    steps.wanted_runs = 1;
  else
    steps.formal_order = order_of(scenario.integrator.scheme);
  double before = scenario.integrator.step;
  for (const double factor : {2.0, 4.0}) {
    const double step = std::min(factor * scenario.integrator.step, scenario.duration);
    if (!(step > before * (1 + 1e-9))) break;
    before = step;
    steps.runs.push_back(longer_steps(scenario, factor));
    if (std::ssize(steps.runs) == steps.wanted_runs) break;
  }
  if (steps.runs.empty()) steps.left_out = "the run is one step, which can't be longer";
  return steps;
}

bool can_touch(const sim::Scenario& scenario, const sim::Body& body) {
  if (!scenario.contact || !body.collides) return false;
  return scenario.contacts.empty() ||
         std::any_of(scenario.contacts.begin(), scenario.contacts.end(),
                     [&](const sim::ContactPair& pair) {
                       return sim::fits(pair.a, body.name) || sim::fits(pair.b, body.name);
                     });
}

Direction softer_contact(const sim::Scenario& scenario, bool anything_touches) {
  Direction contact{"contact"};
  if (!scenario.contact || !anything_touches) {
    contact.remark = "nothing touches";
    return contact;
  }
  if (is_static(scenario)) {
    contact.remark =
        "multipliers bound depths by 1/100 of an element, and forces do not depend on the penalty: "
        "what is left is varied with the mesh";
    return contact;
  }
  const auto is_tissue = [](const sim::Body& body) { return body.kind == sim::Body::Kind::Tissue; };
  const bool averaged = scenario.contact_response == sim::Scenario::Response::Averaged;
  const bool has_tissue = std::any_of(
      scenario.bodies.begin(), scenario.bodies.end(),
      [&](const sim::Body& body) { return is_tissue(body) && can_touch(scenario, body); });
  if (!averaged || !has_tissue) {
    contact.left_out =
        averaged ? kRigidPairs : "contact_response \"pointwise\" has a fixed stiffness";
    return contact;
  }
  if (has_rigid_pair(scenario)) contact.left_out = kRigidPairs;
  const double factor = sim::contact_stiffness_factor(scenario, averaged);
  for (const double softer : {3.0, 9.0})
    contact.runs.push_back({fmt::format("contact {} times softer", softer),
                            {fmt::format("contact_stiffness_factor={}", factor / softer)},
                            softer});
  return contact;
}

std::vector<std::string> looser_tolerance(const sim::Integrator& integrator, double factor) {
  if (integrator.position_tolerance)
    return {fmt::format("integrator.position_tolerance=\"{:.9g} m\"",
                        factor * *integrator.position_tolerance)};
  return {
      fmt::format("integrator.element_tolerance={:.9g}", factor * integrator.element_tolerance)};
}

Direction looser_iteration(const sim::Scenario& scenario) {
  Direction tolerance{"tolerance"};
  if (is_static(scenario)) {
    tolerance.remark =
        fmt::format("forces balance to {} of the largest one, which is not varied", sim::kBalanced);
    return tolerance;
  }
  if (scenario.integrator.scheme == Scheme::Explicit) {
    tolerance.remark = "explicit steps have no iteration";
    return tolerance;
  }
  constexpr double kLooser = 10;
  tolerance.wanted_runs = 1;
  tolerance.runs.push_back({fmt::format("tolerance {} times", kLooser),
                            looser_tolerance(scenario.integrator, kLooser),
                            kLooser,
                            "",
                            {}});
  return tolerance;
}

}  // namespace articular::tools
