#include "sim/build/unit_doubts.hpp"

#include <fmt/format.h>

#include "sim/base/error.hpp"

namespace articular::sim {
namespace {

struct Usual {
  double least, most;
};

// Of what moves or gives way. Lungs have 200 kg/m³, tungsten has 19300; brain has a shear modulus
// of about 500 Pa, diamond one of 5e11 Pa; the strongest muscle of a man has some thousand newtons.
constexpr Usual kExtent{1e-4, 1}, kTissueDensity{100, 4000}, kRigidDensity{100, 25000},
    kShearModulus{10, 1e12}, kForce{0, 2e4};

bool is_usual(double value, const Usual& range) {
  return value >= range.least && value <= range.most;
}

/// The longest side of the box around it [m].
double extent(const Positions& X) {
  return X.cols() > 0 ? (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).maxCoeff() : 0;
}

}  // namespace

std::vector<std::string> unit_doubts(const Scenario& scenario, const Model& model) {
  std::vector<std::string> doubts;
  const auto doubt = [&](const Location& where, const std::string& what) {
    doubts.push_back(prefix(where) + what + "; is its unit the one that was meant?");
  };
  for (std::size_t b = 0; b < scenario.bodies.size(); ++b) {
    const Body& body = scenario.bodies[b];
    const bool is_tissue = body.kind == Body::Kind::Tissue;
    if (body.kind == Body::Kind::Fixed) continue;  // a floor may have any size
    const BodyModel& made = model.bodies[b];
    const Tissue* const tissue =
        is_tissue ? &model.tissues[static_cast<std::size_t>(made.tissue)] : nullptr;
    const double size = extent(start_positions(model, made));
    if (size > 0 && !is_usual(size, kExtent))
      doubt(body.where, fmt::format("`{}` is {:.3g} mm long", body.name, 1e3 * size));
    if (body.density && !is_usual(*body.density, is_tissue ? kTissueDensity : kRigidDensity))
      doubt(body.where,
            fmt::format("`{}` has a density of {:.3g} kg/m^3, {:.2g} times that of water",
                        body.name, *body.density, *body.density / 1000));
    if (is_tissue && !is_usual(tissue->shear_modulus, kShearModulus))
      doubt(body.material->where,
            fmt::format("`{}` has a shear modulus of {:.3g} Pa", body.name, tissue->shear_modulus));
  }
  for (const Muscle& muscle : scenario.muscles)
    if (muscle.tissue.empty() && !is_usual(muscle.max_force, kForce))
      doubt(muscle.where, fmt::format("muscle `{}` has a largest force of {:.3g} N", muscle.name,
                                      muscle.max_force));
  return doubts;
}

}  // namespace articular::sim
