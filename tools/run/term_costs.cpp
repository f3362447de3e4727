#include "tools/run/term_costs.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "fem/element/smoothed_elasticity.hpp"
#include "sim/assembly/dynamics.hpp"
#include "sim/assembly/solver_setup.hpp"
#include "sim/contact/contact_search.hpp"
#include "sim/lines/line_path.hpp"
#include "sim/model/held_blocks.hpp"
#include "sim/time/explicit_limit.hpp"

namespace articular::tools {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The least of some calls: what is measured beside other programs is never too short.
template <class Call>
double seconds_of(Call&& call) {
  constexpr double kEnough = 0.03;  // [s]
  constexpr int kMost = 20;
  double least = std::numeric_limits<double>::infinity();
  const auto begin = Clock::now();
  for (int k = 0; k < kMost && (k == 0 || seconds_since(begin) < kEnough); ++k) {
    const auto start = Clock::now();
    call();
    least = std::min(least, seconds_since(start));
  }
  return least;
}

int free_nodes(const sim::Tissue& tissue) {
  return static_cast<int>(std::count_if(tissue.nodes.begin(), tissue.nodes.end(),
                                        [](const sim::NodeRef& node) { return node.rigid < 0; }));
}

class Measurement {
 public:
  Measurement(const sim::Model& model, const sim::StepSettings& settings)
      : model_(model), settings_(settings), y_(sim::initial_state(model)) {}

  SceneCosts costs() {
    sim::read_state(model_, y_.data(), 0, now_);
    const double before = heap_in_use();
    if (!model_.contacts.empty()) measure_detection();
    const double with_trees = heap_in_use();
    sim::Dynamics dynamics(model_);
    if (search_) dynamics.set_candidates(search_->candidates());
    dynamics.evaluate(y_.data(), 0);
    measure_whole(dynamics);
    costs_.detection_bytes = with_trees - before;
    costs_.matrix_bytes = heap_in_use() - with_trees;
    measure_tissues();
    name_bones();
    measure_lines(true);
    measure_lines(false);
    name_loads();
    measure_contact(dynamics);
    measure_inertia(dynamics);
    measure_linear_solver(dynamics);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    costs_.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
    find_explicit_limit(dynamics);
    return costs_;
  }

 private:
  bool in_time() const { return !model_.is_static; }

  void measure_detection() {
    search_.emplace(model_, settings_);
    search_->find(now_, model_.detection_margin);
    const sim::EvaluationCounts& once = search_->counts().evaluations;
    costs_.possible_pairs = model_.contacts.size();
    costs_.near_pairs = once[sim::Term::PairQuery];
    costs_.detection_seconds = seconds_of([&] { search_->find(now_, model_.detection_margin); });
    // By phase, the least of some: see seconds_of().
    constexpr int kSearches = 5;
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    double update = kInfinite, traversal = kInfinite, narrow = kInfinite;
    std::int64_t narrow_tests = 0;
    for (int k = 0; k < kSearches; ++k) {
      const sim::SearchCounts start = search_->counts();
      search_->find(now_, model_.detection_margin);
      const sim::SearchCounts& end = search_->counts();
      update = std::min(update, end.update_seconds - start.update_seconds);
      traversal = std::min(traversal, end.traversal_seconds - start.traversal_seconds);
      narrow = std::min(narrow, end.narrow_seconds - start.narrow_seconds);
      narrow_tests = end.narrow_tests - start.narrow_tests;
    }
    costs_.terms.push_back(
        {fmt::format("contact detection: trees of {} bodies", bodies_that_touch()), 0, update, 0});
    costs_.terms.push_back({fmt::format("contact detection: traversal, {} of {} pairs near",
                                        costs_.near_pairs, costs_.possible_pairs),
                            0, traversal, 0});
    costs_.terms.push_back(
        {fmt::format("contact detection: {} narrow tests", narrow_tests), 0, narrow, 0});
  }

  std::int64_t bodies_that_touch() const {
    return std::count_if(model_.bodies.begin(), model_.bodies.end(),
                         [](const sim::BodyModel& body) { return body.collider.has_value(); });
  }

  void measure_whole(sim::Dynamics& dynamics) {
    costs_.evaluation_seconds = seconds_of([&] { dynamics.evaluate(y_.data(), 0); });
  }

  void measure_tissues() {
    for (const sim::Tissue& tissue : model_.tissues) {
      const std::string& name = model_.bodies[static_cast<std::size_t>(tissue.body)].name;
      const sim::TissueElements& elements = tissue.elements;
      const bool smoothed = elements.smoothed() != nullptr;
      const double activation = tissue.muscle >= 0 ? 1 : 0;
      Positions f = Positions::Zero(3, tissue.X.cols());
      Eigen::VectorXd pressure;
      TermCost cost;
      cost.term = fmt::format("elasticity of `{}`, {} {}{}", name, elements.num_elements(),
                              smoothed ? "smoothed" : "plain",
                              tissue.muscle >= 0 ? ", with active fibres" : "");
      cost.unknowns = 3 * free_nodes(tissue) - sim::num_held_freedoms(model_, tissue);
      cost.force_seconds = seconds_of([&] {
        elements.pressure(tissue.X, pressure);
        elements.add_internal_force(tissue.X, pressure, activation, f);
      });
      fem::BlockMatrix K = elements.make_matrix();
      cost.matrix_seconds = seconds_of([&] {
        elements.add_stiffness(tissue.X, pressure, activation, fem::Tangent::Consistent, 1, K);
      });
      costs_.terms.push_back(cost);
      const Positions v = Positions::Zero(3, tissue.X.cols());
      if (tissue.dashpots)
        costs_.terms.push_back(
            {fmt::format("dampers of `{}`", name), 0,
             seconds_of([&] { tissue.dashpots->add_force(tissue.X, v, f); }),
             seconds_of([&] { tissue.dashpots->add_tangent(tissue.X, v, 1, 1, K); })});
      if (tissue.relaxation) measure_relaxation(tissue, name, f);
      if (!tissue.sheets.empty()) measure_sheets(tissue, name, f);
    }
  }

  void measure_sheets(const sim::Tissue& tissue, const std::string& name, Positions& f) {
    const auto each = [&](const auto& use) {
      return seconds_of([&] {
        for (const sim::SheetModel& sheet : tissue.sheets) use(sheet.fibres);
      });
    };
    fem::BlockMatrix K = tissue.elements.make_plain_matrix();
    costs_.terms.push_back(
        {fmt::format("{} sheets on `{}`", tissue.sheets.size(), name), 0,
         each([&](const fem::FibreSheet& sheet) { sheet.add_force(tissue.X, f); }),
         each([&](const fem::FibreSheet& sheet) { sheet.add_stiffness(tissue.X, 1, K); })});
  }

  void measure_relaxation(const sim::Tissue& tissue, const std::string& name, Positions& f) {
    Eigen::VectorXd stress, internal_variables;
    const double seconds = seconds_of([&] {
      tissue.relaxation->stress(tissue.X, 0, stress);
      tissue.relaxation->settle(stress, internal_variables);
      tissue.relaxation->add_force(tissue.X, internal_variables, 1, f);
    });
    costs_.terms.push_back(
        {fmt::format("relaxation of `{}`, {} terms", name, tissue.relaxation->num_terms()), 0,
         seconds, 0});
  }

  /// Six unknowns each, but for what is held.
  void name_bones() {
    for (const sim::RigidBody& rigid : model_.rigid_bodies) {
      if (!rigid.unknown) continue;
      const auto held =
          rigid.hold ? std::count(rigid.hold->held.begin(), rigid.hold->held.end(), true) : 0;
      costs_.terms.push_back(
          {fmt::format("rigid body `{}`", model_.bodies[static_cast<std::size_t>(rigid.body)].name),
           static_cast<int>(6 - held), 0, 0});
    }
  }

  /// They are evaluated along with all others, and cost next to nothing.
  void name_loads() {
    if (!model_.gravity.empty()) costs_.terms.push_back({"gravity", 0, 0, 0});
    if (!model_.forces.empty())
      costs_.terms.push_back({fmt::format("{} forces", model_.forces.size()), 0, 0, 0});
    if (!model_.moments.empty())
      costs_.terms.push_back({fmt::format("{} moments", model_.moments.size()), 0, 0, 0});
    if (!model_.surface_loads.empty())
      costs_.terms.push_back(
          {fmt::format("{} loads on surfaces", model_.surface_loads.size()), 0, 0, 0});
  }

  void measure_inertia(const sim::Dynamics& dynamics) {
    if (!in_time()) return;
    const Eigen::VectorXd b = Eigen::VectorXd::Ones(3 * model_.layout.num_unknown_blocks());
    Eigen::VectorXd r;
    costs_.terms.push_back({"inertia", 0, seconds_of([&] { dynamics.multiply_mass(b, r); }), 0});
  }

  void measure_lines(bool muscles) {
    std::vector<const sim::Line*> lines;
    for (const sim::Line& line : model_.lines)
      if ((line.muscle >= 0) == muscles) lines.push_back(&line);
    if (lines.empty()) return;
    Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * model_.num_blocks);
    const double seconds = seconds_of([&] {
      for (const sim::Line* line : lines) add_line(*line, f);
    });
    costs_.terms.push_back(
        {fmt::format("{} {}", lines.size(), muscles ? "muscle lines" : "ligaments"), 0, seconds,
         0});
  }

  void add_line(const sim::Line& line, Eigen::VectorXd& f) const {
    const auto add = [&](std::span<const sim::WeightedPoint> path) {
      sim::add_line_force(path, now_, sim::line_state(model_, line, path, now_).tension, f);
    };
    if (line.wrap.strings.empty())
      add(line.path);
    else
      add(sim::path_from_start(model_, line, now_));
  }

  void measure_contact(sim::Dynamics& dynamics) {
    if (!search_) return;
    std::size_t candidates = 0;
    for (const sim::CandidateList& list : search_->candidates()) candidates += list.pairs.size();
    const auto acts = [&](double sim::SurfaceLaw::*what) {
      return model_.contacts.any([&](const sim::ContactModel& c) { return c.law.*what > 0; });
    };
    const double before = dynamics.times().contact_force;
    dynamics.evaluate(y_.data(), 0);
    costs_.terms.push_back({fmt::format("contact response: {} candidates{}{}", candidates,
                                        acts(&sim::SurfaceLaw::friction) ? ", friction" : "",
                                        acts(&sim::SurfaceLaw::damping) ? ", damping" : ""),
                            0, dynamics.times().contact_force - before, 0});
  }

  /// Takes memory that a run does not.
  void find_explicit_limit(sim::Dynamics& dynamics) {
    constexpr double kAccuracy = 0.01;
    if (!in_time() || model_.layout.num_unknown_blocks() == 0) return;
    const double step =
        sim::longest_explicit_step(sim::fastest_rates(model_, dynamics, y_, 0, kAccuracy));
    if (std::isfinite(step)) costs_.longest_explicit_step = step;
  }

  void measure_linear_solver(sim::Dynamics& dynamics) {
    if (!sim::needs_linear_solver(model_, settings_.scheme) ||
        model_.layout.num_unknown_blocks() == 0)
      return;
    const double h = settings_.step;
    // In statics what nothing holds yet would make it singular: masses stand in for contact.
    const sim::SystemScale scale{1, h, h * h, h};
    costs_.assembly_seconds =
        seconds_of([&] { dynamics.assemble(scale, fem::Tangent::Projected); });
    const sim::NewtonEquations equations = dynamics.assemble(scale, fem::Tangent::Projected);
    const double with_matrix = heap_in_use();
    const auto solver = sim::make_linear_solver(model_);
    bool ready = false;
    // The first time finds an order of the unknowns too, which serves as long as the pattern stays.
    for (int k = 0; k < 2; ++k) {
      const auto start = Clock::now();
      ready = sim::prepare_linear(*solver, equations, dynamics.now().configuration.x);
      costs_.factor_seconds = seconds_since(start);
    }
    costs_.solver_bytes = heap_in_use() - with_matrix;
    if (!ready) return;
    Eigen::VectorXd w = Eigen::VectorXd::Zero(equations.A.num_blocks() * 3);
    const Eigen::VectorXd b = Eigen::VectorXd::Ones(w.size());
    costs_.solve_seconds = seconds_of([&] {
      w.setZero();
      static_cast<void>(solver->solve(b, w));
    });
    costs_.terms.push_back(
        {"linear solver: factor and solution", 0, costs_.factor_seconds + costs_.solve_seconds, 0});
  }

  const sim::Model& model_;
  const sim::StepSettings& settings_;
  Eigen::VectorXd y_;
  sim::Configuration now_;
  std::optional<sim::ContactSearch> search_;
  SceneCosts costs_;
};

}  // namespace

double heap_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

SceneCosts measure_costs(const sim::Model& model, const sim::StepSettings& settings) {
  return Measurement(model, settings).costs();
}

}  // namespace articular::tools
