#include "tools/verify/lines.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "tools/verify/scene.hpp"

namespace articular::tools {
namespace {

/// Laws are formulas: what is left is the rounding to the nine digits of history.csv.
constexpr double kNineDigits = 5.1e-9;

/// scenarios/verification/muscle_block.toml as a line of 20 mm and 30 N.
Curves muscle_line(const Laboratory& laboratory, std::vector<std::string> overrides) {
  overrides.insert(overrides.end(), {"choice.muscle=line", "integrator.scheme=dirk-3",
                                     "integrator.step=1 ms", "output.interval=0.1 s"});
  return run_scene(laboratory, shipped_scene("muscle_block", std::move(overrides)));
}

/// Isometric force, pulling `high` down: F_max a f_l(n), and at the length l > l_opt the passive
/// F_max 0.015 (l/l_opt − 1)/0.3 besides. f_l = ½ (1 + cos 2πn). [Peck 2000, Arch Oral Biol 45:963]
std::vector<Finding> isometric_muscle(const Laboratory& laboratory) {
  constexpr double most = 30, activation = 0.02;  // [N], [-]
  constexpr double tau = 5e-3, ramp = 1e-3;       // [s] of the activation; of its excitation
  const Curves at_optimum = muscle_line(laboratory, {});
  // ȧ = (u − a)/τ with u rising within `ramp`: a = u (1 − τ/ramp (e^(ramp/τ) − 1) e^(−t/τ)). Of
  // third order, in steps of a fifth of τ, whose error is (1/5)⁴/24.
  const double t = 10e-3;
  const double risen = 1 - tau / ramp * std::expm1(ramp / tau) * std::exp(-t / tau);
  constexpr double kSteps = 1e-3;
  const std::string pull = "pull.force.z [N]";
  std::vector<Finding> findings = {
      relative("force at the optimal length", "N", -most * activation, at_optimum.last(pull),
               kNineDigits),
      relative("force 10 ms after the onset", "N", -most * activation * risen,
               at_optimum.at(pull, t), kSteps)};
  for (const double optimal : {16.0, 24.0}) {  // [mm], of 20
    const Curves curves =
        muscle_line(laboratory, {fmt::format("muscle.0.optimal_length={} mm", optimal)});
    const double n = 20 / optimal;
    const double active = 0.5 * (1 + std::cos(2 * std::numbers::pi * n));
    const double passive = n > 1 ? 0.015 * (n - 1) / 0.3 : 0;
    findings.push_back(relative(fmt::format("force at {:.3g} of the optimal length", n), "N",
                                -most * (activation * active + passive), curves.last(pull),
                                kNineDigits));
  }
  return findings;
}

/// scenarios/verification/ligaments.toml, whose file has the laws.
std::vector<Finding> ligaments(const Laboratory& laboratory) {
  const Curves curves =
      run_scene(laboratory, shipped_scene("ligaments", {"integrator.step=0.1 s"}));
  const auto linear = [&](double time, double extension) {
    return relative(fmt::format("linear, drawn out by {:.3g} mm", extension), "N",
                    10 * (extension - 1), curves.at("linear.force [N]", time), kNineDigits);
  };
  const auto toe = [&](double time, double strain) {
    const double force =
        strain < 0.06 ? 2000 * strain * strain / (4 * 0.03) : 2000 * (strain - 0.03);
    return relative(fmt::format("with a toe, strained by {:.3g}", strain), "N", force,
                    curves.at("toe.force [N]", time), kNineDigits);
  };
  return {vanishing("linear, slack", "N", curves.at("linear.force [N]", 0.2), 1, 0),
          linear(0.5, 2),
          linear(1, 4),
          toe(0.1, 0.02),
          toe(0.2, 0.04),
          toe(0.4, 0.08),
          toe(1, 0.2),
          relative("pull on the upper body", "N", -30 - 340, curves.last("high.force.z [N]"),
                   kNineDigits)};
}

/// scenarios/verification/pennate_muscle.toml, whose file has the planar model. Ends of the block
/// are free, so fibres there give way.
std::vector<Finding> pennate_muscle(const Laboratory& laboratory) {
  constexpr double kEnds = 0.025;
  constexpr double area = 600, thickness = 10, along = 27.47;  // [mm²], [mm]
  constexpr double stress = 0.4, ground = 0.02;                // [MPa]
  const double fibre = std::hypot(along, thickness);           // [mm]
  const Curves curves = run_scene(laboratory, shipped_scene("pennate_muscle", {}));
  const auto pull = [&](double time, double shortening) {
    const double now = std::hypot(along - shortening, thickness), stretch = now / fibre;
    const double active = stress * (1 - 4 * (1 - stretch) * (1 - stretch)) * thickness / fibre *
                          (along - shortening) / now;
    return relative(fmt::format("pull, shortened by {:.3g} mm", shortening), "N",
                    -area * (active - ground * shortening / thickness),
                    curves.at("insertion.force.x [N]", time), kEnds);
  };
  const auto stretch = [&](double time, double shortening) {
    return relative(fmt::format("stretch of fibres, shortened by {:.3g} mm", shortening), "-",
                    std::hypot(along - shortening, thickness) / fibre,
                    curves.at("fibres.stretch [-]", time), kEnds);
  };
  return {pull(0.2, 0), pull(0.6, 3), pull(1, 6), stretch(0.6, 3), stretch(1, 6)};
}

}  // namespace

std::vector<Problem> line_problems() {
  return {{"line/muscle", true, isometric_muscle},
          {"line/ligament", true, ligaments},
          {"line/pennate-muscle", true, pennate_muscle}};
}

}  // namespace articular::tools
