// stability_limits: the longest stable step of the explicit scheme, from theory and by trying, and
// what implicit schemes make of steps a million times as long. A table in Markdown.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "sim/assembly/energies.hpp"
#include "sim/build/build_model.hpp"
#include "sim/time/explicit_limit.hpp"
#include "tests/sim/support/scene.hpp"
#include "tests/sim/support/stability_trial.hpp"

namespace articular::sim {
namespace {

using Element = TissueMaterial::Element;
using Scheme = Integrator::Scheme;

struct Bar {
  std::string name;
  Element element = Element::Plain;
  int cells = 2;  // across; three times as many along
  double young = 20e3, nu = 0.45;
  double stiffness_damping = 0;  // β [s]
};

/// 10 x 10 x 30 mm, tied at one end.
Scenario scenario_of(const Bar& bar) {
  Scenario s = scene(1, Scheme::Explicit);
  s.bodies = {box_body("bar", Body::Kind::Tissue, {0.01, 0.01, 0.03}, {0, 0, 0.015},
                       {bar.cells, bar.cells, 3 * bar.cells}),
              stand("wall")};
  s.bodies[0].material = neo_hookean(bar.young, bar.nu);
  s.bodies[0].material->element = bar.element;
  s.bodies[0].material->stiffness_damping = bar.stiffness_damping;
  s.attachments = {attach("bar", "wall", {-1, -1, -1e-6}, {1, 1, 1e-6})};
  return s;
}

/// Between a step that fades and one that grows, to 0.1 %: 4000 steps tell that apart.
double step_found(const Model& model, double guess) {
  constexpr double kResolution = 1e-3;
  constexpr int kSteps = 4000;
  double low = 0.5 * guess, high = 2 * guess;
  if (explicit_steps_grow(model, low, kSteps)) return 0;
  while (high - low > kResolution * guess) {
    const double middle = 0.5 * (low + high);
    (explicit_steps_grow(model, middle, kSteps) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// The mean of the steps that error control chooses, with a tolerance of 1 µm, which is no bound.
double step_chosen(const Bar& bar, double limit) {
  constexpr int kSteps = 1000;
  Scenario s = scenario_of(bar);
  s.bodies[0].velocity = {0.05, 0, 0};  // [m/s]
  s.integrator.step = 100 * limit;
  s.integrator.position_tolerance = 1e-6;
  Simulation run(s);
  run.advance(kSteps * limit);
  return run.state.t / static_cast<double>(run.state.counts.steps);
}

double energy(Dynamics& dynamics, const Eigen::VectorXd& y, double t) {
  dynamics.evaluate(y.data(), t);
  return kinetic_energy(dynamics.now()) + elastic_energy(dynamics.now());
}

/// Whether, let go a little out of shape, there ever is more than there was.
bool makes_energy(const Scenario& scenario, double h) {
  constexpr int kSteps = 100;
  constexpr double kRoundOff = 1e-6;
  const Model model = build_model(scenario);
  Dynamics dynamics(model);
  const auto integrator = make_time_integrator(model, dynamics, step_settings(scenario));
  Eigen::VectorXd y = initial_state(model);
  Random random(3);
  const int num_positions = 3 * model.layout.num_free_nodes;
  y.head(num_positions) += 1e-4 * model.trusted_motion * random.vector(num_positions);
  const double start = energy(dynamics, y, 0);
  for (int k = 0; k < kSteps; ++k) {
    if (!integrator->advance(y, k * h, h)) return true;
    if (energy(dynamics, y, (k + 1) * h) > (1 + kRoundOff) * start) return true;
  }
  return false;
}

/// Steps of 1, 10² ... 10⁶ times the explicit limit; 0 if none made energy, else the first that
/// did.
double first_that_grows(const Bar& bar, Scheme scheme, double limit) {
  for (const double times : {1.0, 1e2, 1e4, 1e6}) {
    Scenario s = scenario_of(bar);
    s.integrator.scheme = scheme;
    s.integrator.step = times * limit;
    s.integrator.position_tolerance = 1e-13;
    if (makes_energy(s, times * limit)) return times;
  }
  return 0;
}

std::string implicit_words(const Bar& bar, double limit) {
  std::string words;
  for (const auto& [scheme, name] : {std::pair(Scheme::ImplicitEuler, "implicit-euler"),
                                     {Scheme::TrBdf2, "tr-bdf2"},
                                     {Scheme::Dirk3, "dirk-3"}}) {
    const double times = first_that_grows(bar, scheme, limit);
    if (times > 0) words += fmt::format("{}{} at {:g}", words.empty() ? "" : ", ", name, times);
  }
  return words.empty() ? "none" : words;
}

void print_row(const Bar& bar) {
  const Model model = build_model(scenario_of(bar));
  Dynamics dynamics(model);
  const MotionRates rates = fastest_rates(model, dynamics, initial_state(model), 0, 1e-4);
  const double limit = longest_explicit_step(rates), found = step_found(model, limit),
               chosen = step_chosen(bar, limit);
  const std::complex<double>& fastest = rates.front();
  const bool swings = std::abs(fastest.imag()) > std::abs(fastest.real());
  fmt::print("| {} | {} | {} {:.5g} | {:.4g} | {:.4g} | {:+.1f} % | {:.4g} | {} |\n", bar.name,
             3 * model.layout.num_unknown_blocks(), swings ? "± i" : "-", std::abs(fastest),
             1e6 * limit, 1e6 * found, 100 * (found / limit - 1), 1e6 * chosen,
             implicit_words(bar, limit));
  std::fflush(stdout);
}

void print_table() {
  fmt::print(
      "| bar | unknowns | fastest rate λ [1/s] | step by theory [µs] | found [µs] | | by error "
      "control [µs] | implicit steps to 10⁶ times that make energy |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  const std::vector<Bar> bars = {
      {.name = "plain"},
      {.name = "smoothed", .element = Element::Smoothed},
      {.name = "100 times as stiff", .young = 2e6},
      {.name = "half the elements' size", .cells = 4},
      {.name = "plain, ν = 0.499", .nu = 0.499},
      {.name = "smoothed, ν = 0.499", .element = Element::Smoothed, .nu = 0.499},
      {.name = "dampers, β = 0.1 ms", .stiffness_damping = 1e-4},
      {.name = "dampers, β = 5 ms", .stiffness_damping = 5e-3},
  };
  for (const Bar& bar : bars) print_row(bar);
}

}  // namespace
}  // namespace articular::sim

int main() { articular::sim::print_table(); }
