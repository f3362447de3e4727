#include "sim/build/unit_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>
#include <variant>

#include "sim/base/whole_turn.hpp"
#include "sim/build/usual.hpp"
#include "sim/mesh/extent.hpp"
#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

// Of what moves or gives way. Lungs have 200 kg/m³, tungsten has 19300; the strongest muscle of a
// man has some thousand newtons. The whole patellar tendon has 4000 N/mm at most, and 2e5 N per
// unit of strain. Rubber has a friction coefficient of 1 to 2, and ligaments tear at a strain of
// 0.1 to 0.3. A basement membrane is less than 1 um thick, fasciae and aponeuroses up to 2 mm; skin
// has 0.1 MPa and more along its fibres.
constexpr Usual kExtent{1e-4, 1}, kTissueDensity{100, 4000}, kRigidDensity{100, 25000},
    kUsualForce{0, 2e4}, kUsualMoment{0, 2e3}, kUsualMass{0, 100}, kGravity{0.1, 50},
    kSlackLength{0, 1}, kStiffness{1, 1e7}, kStiffnessPerStrain{1, 1e6}, kFriction{0, 2},
    kToeStrain{0, 0.5}, kMuscleSpeed{0.5, 5000}, kPassiveFraction{0, 1}, kShift{0, 1},
    kSheetThickness{1e-7, 5e-3}, kSheetModulus{1e4, 2e10}, kLayerThickness{1e-6, 2e-2},
    kLayerModulus{1e3, 2e11}, kActivationTime{1e-4, 1}, kLengthRatio{1, 3}, kSpeed{0, 20};

constexpr double kFarthest = 2;  // [m] of a line's end or a probe's point from its body's middle

const std::vector<double>& times_of(const Load& load) {
  return std::visit(
      [](const auto& kind) -> const std::vector<double>& {
        if constexpr (std::is_same_v<decltype(kind), const MotionLoad&>)
          return kind.motion.time;
        else
          return kind.profile.time;
      },
      load);
}

/// Activation follows in tens of milliseconds: an excitation that is over so soon [s], early in the
/// run, was meant to be in other units.
constexpr double kShortestExcitation = 1e-3, kEarly = 0.1;

template <class Doubt>
void doubt_short_excitations(const Scenario& scenario, const Doubt& doubt) {
  if (scenario.analysis == Scenario::Analysis::Static) return;
  for (const Muscle& muscle : scenario.muscles) {
    const std::vector<double>& times = muscle.excitation.time;
    if (times.size() > 1 && times.back() < kShortestExcitation &&
        times.back() < kEarly * scenario.duration)
      doubt(muscle.where,
            fmt::format("the excitation of `{}` changes within {:.3g} ms and no more, in a run of "
                        "{:.4g} s",
                        muscle.name, 1e3 * times.back(), scenario.duration));
  }
}

/// Curves of which a run sees nothing but the first value: "10 s" for "10 ms".
template <class Doubt>
void doubt_times(const Scenario& scenario, const Doubt& doubt) {
  const auto look_at = [&](const std::vector<double>& times, const Location& where,
                           const std::string& what) {
    if (times.size() > 1 && times.front() >= scenario.duration)
      doubt(where, fmt::format("{} begins at {:.4g} s, when the run of {:.4g} s is over", what,
                               times.front(), scenario.duration));
  };
  for (const Load& load : scenario.loads)
    look_at(times_of(load), std::visit([](const auto& kind) { return kind.where; }, load),
            "a load's curve");
  for (const Muscle& muscle : scenario.muscles)
    look_at(muscle.excitation.time, muscle.where,
            fmt::format("the excitation of `{}`", muscle.name));
  for (const Bolus& bolus : scenario.boluses)
    if (bolus.from >= scenario.duration)
      doubt(bolus.where, fmt::format("bolus `{}` is put in at {:.4g} s, when the run of {:.4g} s "
                                     "is over",
                                     bolus.name, bolus.from, scenario.duration));
}

/// Plain numbers that were given in per cent.
template <class Doubt>
void doubt_ratios(const Scenario& scenario, const Doubt& doubt) {
  for (const ContactPair& pair : scenario.contacts)
    if (!is_usual(pair.friction, kFriction))
      doubt(pair.where, fmt::format("`{}` and `{}` have a friction coefficient of {:.3g}, usual is "
                                    "up to {:g}",
                                    pair.a, pair.b, pair.friction, kFriction.most));
  for (const Ligament& ligament : scenario.ligaments)
    if (ligament.law == Ligament::Law::Blankevoort && !is_usual(ligament.toe_strain, kToeStrain))
      doubt(ligament.where, fmt::format("ligament `{}` has a toe strain of {:.3g}, usual is up to "
                                        "{:g}",
                                        ligament.name, ligament.toe_strain, kToeStrain.most));
  for (const Sheet& sheet : scenario.sheets)
    if (!is_usual(sheet.toe_strain, kToeStrain))
      doubt(sheet.where, fmt::format("sheet `{}` has a toe strain of {:.3g}, usual is up to {:g}",
                                     sheet.name, sheet.toe_strain, kToeStrain.most));
}

double largest_factor(const Curve& profile) {
  double most = profile.value.empty() ? 1 : 0;
  for (const double value : profile.value) most = std::max(most, std::abs(value));
  return most;
}

/// Pressures and tractions that would press a column of the tissue to nothing.
template <class Doubt>
void doubt_surface_loads(const Scenario& scenario, const Model& model, const Doubt& doubt) {
  for (const Load& any : scenario.loads) {
    const auto* const load = std::get_if<SurfaceLoad>(&any);
    if (load == nullptr) continue;
    const double* const pressure = std::get_if<double>(&load->stress);
    const double stress =
        largest_factor(load->profile) *
        (pressure != nullptr ? std::abs(*pressure) : std::get<Vec3>(load->stress).norm());
    const auto body = static_cast<std::size_t>(body_index(scenario, load->at.tissue));
    const double modulus =
        constrained_modulus(model.tissues[static_cast<std::size_t>(model.bodies[body].tissue)]);
    if (stress > modulus)
      doubt(load->where,
            fmt::format("the {} of {:.3g} kPa on `{}` is {:.2g} times its modulus in confined "
                        "compression",
                        pressure != nullptr ? "pressure" : "traction", 1e-3 * stress,
                        load->at.tissue, stress / modulus));
  }
}

/// A body, and a point that goes with it.
using PlaceOfProbe = std::pair<std::string, Vec3>;

std::vector<PlaceOfProbe> places_of(const Probe& probe) {
  return std::visit(
      [](const auto& what) -> std::vector<PlaceOfProbe> {
        if constexpr (requires { what.proximal; })
          return {{what.proximal.body, what.proximal.origin},
                  {what.distal.body, what.distal.origin}};
        else if constexpr (requires {
                             what.body;
                             what.point;
                           })
          return {{what.body, what.point}};
        else if constexpr (requires {
                             what.frame;
                             what.point;
                           })
          return {{what.frame, what.point}};
        else
          return {};
      },
      probe.what);
}

/// Points that lie nowhere near their bodies: metres for millimetres.
template <class Doubt>
void doubt_points(const Scenario& scenario, const Model& model, const Doubt& doubt) {
  const auto middle_of = [&](const BodyModel& body) -> Vec3 {
    const Positions x = start_positions(model, body);
    if (x.cols() > 0) return x.rowwise().mean();
    if (body.rigid < 0) return Vec3::Zero();
    return model.rigid_bodies[static_cast<std::size_t>(body.rigid)].rest.p;
  };
  std::vector<Vec3> middles;
  for (const BodyModel& body : model.bodies) middles.push_back(middle_of(body));
  const auto is_doubted = [&](const Location& where, const std::string& what,
                              const std::string& body, const Vec3& point) {
    const double distance =
        (point - middles[static_cast<std::size_t>(body_index(scenario, body))]).norm();
    if (distance <= kFarthest) return false;
    doubt(where, fmt::format("{} {:.3g} m from the middle of `{}`, usual is less than {} m", what,
                             distance, body, kFarthest));
    return true;
  };
  const auto look_at = [&](const auto& lines, const char* kind) {
    for (const auto& line : lines)
      for (const Anchor& anchor : line.path)
        if (is_doubted(line.where, fmt::format("{} `{}` has a point", kind, line.name), anchor.body,
                       anchor.point))
          break;
  };
  look_at(scenario.muscles, "muscle");
  look_at(scenario.ligaments, "ligament");
  for (const Body& body : scenario.bodies)
    if (body.hold && body.hold->at)
      is_doubted(body.where, fmt::format("`{}` is held at a point", body.name), body.name,
                 *body.hold->at);
  for (const Probe& probe : scenario.probes)
    for (const auto& [body, point] : places_of(probe))
      is_doubted(probe.where, fmt::format("probe `{}` has a point", probe.name), body, point);
}

/// What loads do at most over time.
template <class Doubt>
struct DoubtLoad {
  const Doubt& doubt;

  void operator()(const GravityLoad& load) const {
    const double most = load.acceleration.norm() * largest_factor(load.profile);
    if (most > 0 && !is_usual(most, kGravity))
      doubt(load.where, fmt::format("gravity is {:.3g} m/s^2, on earth it is 9.81 m/s^2", most));
  }
  void operator()(const ForceLoad& load) const {
    const double most = load.force.norm() * largest_factor(load.profile);
    if (!is_usual(most, kUsualForce)) doubt(load.where, fmt::format("a force is {:.3g} N", most));
  }
  void operator()(const MomentLoad& load) const {
    const double most = load.moment.norm() * largest_factor(load.profile);
    if (!is_usual(most, kUsualMoment))
      doubt(load.where, fmt::format("a moment is {:.3g} N m", most));
  }
  void operator()(const SurfaceLoad& /*load*/) const {}  // by the modulus of the tissue
  /// Radians are read as degrees, and degrees as radians.
  void operator()(const MotionLoad& load) const {
    const std::string& moved = load.body.empty() ? load.support : load.body;
    const double turn = largest(load.motion.rotation), way = largest(load.motion.translation);
    if (turn > kWholeTurn)
      doubt(load.where, fmt::format("a motion turns `{}` by {:.4g} degrees", moved,
                                    turn * 180 / std::numbers::pi));
    if (!is_usual(way, kShift))
      doubt(load.where, fmt::format("a motion shifts `{}` by {:.3g} m", moved, way));
  }

  static double largest(const std::vector<Vec3>& samples) {
    double most = 0;
    for (const Vec3& sample : samples) most = std::max(most, sample.norm());
    return most;
  }
};

template <class Doubt>
void doubt_ligaments(const Scenario& scenario, const Doubt& doubt) {
  for (const Ligament& ligament : scenario.ligaments) {
    if (ligament.slack_length && !is_usual(*ligament.slack_length, kSlackLength))
      doubt(ligament.where, fmt::format("ligament `{}` has a slack length of {:.3g} m, usual is "
                                        "less than {} m",
                                        ligament.name, *ligament.slack_length, kSlackLength.most));
    const bool by_length = ligament.law == Ligament::Law::Linear;
    const Usual& usual = by_length ? kStiffness : kStiffnessPerStrain;
    if (!is_usual(ligament.stiffness, usual))
      doubt(ligament.where,
            fmt::format("ligament `{}` has a stiffness of {:.3g} {}, usual is {:g} to {:g}",
                        ligament.name, (by_length ? 1e-3 : 1) * ligament.stiffness,
                        by_length ? "N/mm" : "N per strain", (by_length ? 1e-3 : 1) * usual.least,
                        (by_length ? 1e-3 : 1) * usual.most));
  }
}

/// @param what  has the thickness [m] and the modulus [Pa]
template <class Doubt>
void doubt_thickness(const Location& where, const std::string& what, double thickness,
                     const Usual& usual, const Doubt& doubt) {
  if (!is_usual(thickness, usual))
    doubt(where, fmt::format("{} is {:.3g} mm thick, usual is {:g} to {:g} mm", what,
                             1e3 * thickness, 1e3 * usual.least, 1e3 * usual.most));
}
template <class Doubt>
void doubt_modulus(const Location& where, const std::string& what, double modulus,
                   const Usual& usual, const Doubt& doubt) {
  if (!is_usual(modulus, usual))
    doubt(where, fmt::format("{} has a modulus of {:.3g} MPa, usual is {:g} to {:g} MPa", what,
                             1e-6 * modulus, 1e-6 * usual.least, 1e-6 * usual.most));
}

template <class Doubt>
void doubt_layer(const Body& body, const Doubt& doubt) {
  const std::string what = fmt::format("the layer of `{}`", body.name);
  doubt_thickness(body.where, what, body.layer->thickness, kLayerThickness, doubt);
  doubt_modulus(body.where, what, body.layer->young_modulus, kLayerModulus, doubt);
}

template <class Doubt>
void doubt_muscles(const Scenario& scenario, const Doubt& doubt) {
  for (const Muscle& muscle : scenario.muscles) {
    for (const auto& [time, what] : {std::pair(muscle.activation_time, "activation"),
                                     std::pair(muscle.deactivation_time, "deactivation")})
      if (scenario.analysis == Scenario::Analysis::Dynamic && !is_usual(time, kActivationTime))
        doubt(muscle.where, fmt::format("muscle `{}` has a time constant of {} of {:.3g} ms, usual "
                                        "is {:g} to {:g} ms",
                                        muscle.name, what, 1e3 * time, 1e3 * kActivationTime.least,
                                        1e3 * kActivationTime.most));
    if (!muscle.tissue.empty()) continue;
    if (!is_usual(muscle.max_force, kUsualForce))
      doubt(muscle.where, fmt::format("muscle `{}` has a largest force of {:.3g} N", muscle.name,
                                      muscle.max_force));
    if (!is_usual(muscle.max_velocity, kMuscleSpeed))
      doubt(muscle.where,
            fmt::format(
                "muscle `{}` shortens by at most {:.3g} lengths a second, usual is {:g} to {:g}",
                muscle.name, muscle.max_velocity, kMuscleSpeed.least, kMuscleSpeed.most));
    if (!is_usual(muscle.passive_fraction, kPassiveFraction))
      doubt(muscle.where, fmt::format("muscle `{}` has a passive force of {:.3g} times its largest "
                                      "active one, usual is up to {:g}",
                                      muscle.name, muscle.passive_fraction, kPassiveFraction.most));
    if (!is_usual(muscle.max_length_ratio, kLengthRatio))
      doubt(muscle.where, fmt::format("the passive force of muscle `{}` is largest at {:.3g} times "
                                      "its optimal length, usual is up to {:g}",
                                      muscle.name, muscle.max_length_ratio, kLengthRatio.most));
  }
}

template <class Doubt>
void doubt_sheets(const Scenario& scenario, const Doubt& doubt) {
  for (const Sheet& sheet : scenario.sheets) {
    const std::string what = fmt::format("sheet `{}`", sheet.name);
    doubt_thickness(sheet.where, what, sheet.thickness, kSheetThickness, doubt);
    doubt_modulus(sheet.where, what, sheet.young_modulus, kSheetModulus, doubt);
  }
}

}  // namespace

std::vector<std::string> unit_doubts(const Scenario& scenario, const Model& model) {
  std::vector<std::string> doubts;
  const auto doubt = [&](const Location& where, const std::string& what) {
    doubts.push_back(unit_doubt(where, what));
  };
  for (std::size_t b = 0; b < scenario.bodies.size(); ++b) {
    const Body& body = scenario.bodies[b];
    const bool is_tissue = body.kind == Body::Kind::Tissue;
    if (body.layer) doubt_layer(body, doubt);
    const bool is_made = !std::holds_alternative<MeshFile>(body.geometry);
    if (body.kind == Body::Kind::Fixed && is_made) continue;  // a floor may have any size
    const double size = extent(start_positions(model, model.bodies[b]));
    if (size > 0 && !is_usual(size, kExtent))
      doubt(body.where, fmt::format("`{}` is {:.3g} mm long", body.name, 1e3 * size));
    if (body.density && !is_usual(*body.density, is_tissue ? kTissueDensity : kRigidDensity))
      doubt(body.where,
            fmt::format("`{}` has a density of {:.3g} kg/m^3, {:.2g} times that of water",
                        body.name, *body.density, *body.density / 1000));
    if (body.mass && !is_usual(*body.mass, kUsualMass))
      doubt(body.where, fmt::format("`{}` has a mass of {:.3g} kg, usual is up to {:.0f} kg",
                                    body.name, *body.mass, kUsualMass.most));
    if (!is_usual(body.velocity.norm(), kSpeed))
      doubt(body.where,
            fmt::format("`{}` starts with {:.3g} m/s", body.name, body.velocity.norm()));
  }
  doubt_muscles(scenario, doubt);
  doubt_ligaments(scenario, doubt);
  doubt_sheets(scenario, doubt);
  doubt_points(scenario, model, doubt);
  for (const Load& load : scenario.loads) std::visit(DoubtLoad<decltype(doubt)>{doubt}, load);
  doubt_surface_loads(scenario, model, doubt);
  doubt_times(scenario, doubt);
  doubt_short_excitations(scenario, doubt);
  doubt_ratios(scenario, doubt);
  return doubts;
}

}  // namespace articular::sim
