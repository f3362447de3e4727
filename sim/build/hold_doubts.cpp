#include "sim/build/hold_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.hpp"
#include "sim/model/constrained_rigid_body.hpp"

namespace articular::sim {
namespace {

constexpr double kNone = 1e-9;  // of a vector's length

/// Onto the axes along and about which a body is free.
struct Free {
  Mat3 shift = Mat3::Zero(), turn = Mat3::Zero();
};

bool is_none(const Vec3& part, const Vec3& whole) { return part.norm() <= kNone * whole.norm(); }

/// A force at a lever from the held point. About one axis it does nothing in any position where
/// either has no part across it; about more, where there is no lever.
bool takes_force(const Free& free, const Vec3& force, const Vec3& lever) {
  if (!is_none(free.shift * force, force)) return false;
  const auto num_turns = std::lround(free.turn.trace());
  if (num_turns == 0) return true;
  const Mat3 across = Mat3::Identity() - free.turn;
  return num_turns == 1 ? is_none(across * force, force) || is_none(across * lever, lever)
                        : lever.isZero(0);
}

bool has_reaction_probe(const Scenario& scenario, const std::string& body) {
  return std::ranges::any_of(scenario.probes, [&](const Probe& probe) {
    const auto* const reaction = std::get_if<ReactionProbe>(&probe.what);
    return reaction != nullptr && reaction->body == body;
  });
}

/// The rigid body of this name if it is held and nothing drives it, with what is free of it.
struct Held {
  const RigidBody* body = nullptr;
  Free free;
};

Held held_body(const Scenario& scenario, const Model& model, const std::string& name) {
  const int rigid = model.bodies[static_cast<std::size_t>(body_index(scenario, name))].rigid;
  if (rigid < 0) return {};
  const RigidBody& body = model.rigid_bodies[static_cast<std::size_t>(rigid)];
  if (!body.unknown || !body.hold || body.motion) return {};
  return {&body, {free_projection(*body.hold, 0), free_projection(*body.hold, 1)}};
}

/// A force or moment on a held body.
struct HeldLoad {
  const char* what;
  std::string body;
  Location where;
  bool is_taken;
};

std::vector<HeldLoad> loads_on_held_bodies(const Scenario& scenario, const Model& model) {
  std::vector<HeldLoad> loads;
  for (const Load& load : scenario.loads) {
    if (const auto* const force = std::get_if<ForceLoad>(&load)) {
      const auto* const anchor = std::get_if<Anchor>(&force->at);
      if (anchor == nullptr || force->force.isZero(0)) continue;
      if (const Held held = held_body(scenario, model, anchor->body); held.body != nullptr)
        loads.push_back({"a force", anchor->body, force->where,
                         takes_force(held.free, force->force, anchor->point - held.body->rest.p)});
    } else if (const auto* const moment = std::get_if<MomentLoad>(&load)) {
      if (moment->moment.isZero(0)) continue;
      if (const Held held = held_body(scenario, model, moment->body); held.body != nullptr)
        loads.push_back({"a moment", moment->body, moment->where,
                         is_none(held.free.turn * moment->moment, moment->moment)});
    }
  }
  return loads;
}

/// One of several loads may be there for the reaction's sake.
bool is_for_the_reaction(const Scenario& scenario, const std::vector<HeldLoad>& loads,
                         const std::string& body) {
  return has_reaction_probe(scenario, body) &&
         std::ranges::any_of(
             loads, [&](const HeldLoad& other) { return other.body == body && !other.is_taken; });
}

}  // namespace

std::vector<std::string> hold_doubts(const Scenario& scenario, const Model& model) {
  std::vector<std::string> doubts;
  const std::vector<HeldLoad> loads = loads_on_held_bodies(scenario, model);
  for (const auto& [what, body, where, is_taken] : loads)
    if (is_taken && !is_for_the_reaction(scenario, loads, body))
      doubts.push_back(prefix(where) +
                       fmt::format("{} on `{}` is taken by its `hold`, wherever it "
                                   "moves: is the direction the one that was meant?",
                                   what, body));
  for (const Probe& probe : scenario.probes) {
    const auto* const angle = std::get_if<AngleProbe>(&probe.what);
    if (angle == nullptr) continue;
    const Held held = held_body(scenario, model, angle->body);
    if (held.body != nullptr && is_none(held.free.turn * angle->axis, angle->axis))
      doubts.push_back(prefix(probe.where) +
                       fmt::format("probe `{}` will be 0: `{}` can't turn about this axis, as its "
                                   "`hold` has it; expected an axis that is free",
                                   probe.name, angle->body));
  }
  return doubts;
}

}  // namespace articular::sim
