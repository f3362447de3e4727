// What a law costs: force and stiffness of a cube of tissue, law by law, in plain and in smoothed
// elements, on one thread.
//
//   build/release/bin/law_speed [CELLS]      (default: 12, of six tetrahedra each)
//
// Nanoseconds of processor time an element, medians of nine rounds in which the laws take turns, so
// that all meet the same noise. Laws and constants are those of the tests (tests/fem/support).

#include <cstdio>
#include <cstdlib>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/element/smoothed_elasticity.hpp"
#include "tests/benchmarks/support/timing.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/laws.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace {

using namespace articular;
using namespace articular::benchmarks;

constexpr int kRounds = 9;
constexpr double kActivation = 0.5;

/// One kind of work on one law.
struct Work {
  std::function<void()> run;
  std::vector<double> seconds;

  void time() {
    const double start = cpu_seconds();
    run();
    seconds.push_back(cpu_seconds() - start);
  }
};

/// A row of the table: energy, force, stiffness, projected stiffness.
struct Row {
  std::string name;
  std::vector<Work> columns;
};

/// @param x  positions, deformed by some per cent
Row plain_row(const fem::LawExample& law, const fem::TetMesh& mesh, const Positions& x) {
  const auto fibres = law.fibred ? FibreDirections(fem::kFibre.replicate(1, mesh.tets.cols()))
                                 : FibreDirections(3, 0);
  const auto elasticity =
      std::make_shared<fem::Elasticity>(mesh.X, mesh.tets, law.material, fibres);
  const auto K = std::make_shared<fem::BlockMatrix>(elasticity->make_matrix());
  const auto stiffness = [=](fem::Tangent tangent) {
    return [=] { elasticity->add_stiffness(x, tangent, 1, *K, kActivation); };
  };
  return {law.name,
          {{[=] { (void)elasticity->energy(x, kActivation); }, {}},
           {[=] {
              Positions f = Positions::Zero(3, x.cols());
              elasticity->add_internal_force(x, f, kActivation);
            },
            {}},
           {stiffness(fem::Tangent::Consistent), {}},
           {stiffness(fem::Tangent::Projected), {}}}};
}

Row smoothed_row(const fem::LawExample& law, const fem::TetMesh& mesh, const Positions& x) {
  const auto fibres = law.fibred ? FibreDirections(fem::kFibre.replicate(1, mesh.tets.cols()))
                                 : FibreDirections(3, 0);
  const auto elasticity = std::make_shared<fem::SmoothedElasticity>(mesh.X, mesh.tets, law.material,
                                                                    fem::Smoothing{}, fibres);
  const auto K = std::make_shared<fem::BlockMatrix>(elasticity->make_matrix());
  const Eigen::VectorXd p = Eigen::VectorXd::Zero(elasticity->num_pressures());
  const auto stiffness = [=](fem::Tangent tangent) {
    return [=] { elasticity->add_stiffness(x, p, tangent, 1, *K, kActivation); };
  };
  return {law.name + ", smoothed",
          {{[=] { (void)elasticity->energy(x, p, kActivation); }, {}},
           {[=] {
              Positions f = Positions::Zero(3, x.cols());
              elasticity->add_internal_force(x, p, f, kActivation);
            },
            {}},
           {stiffness(fem::Tangent::Consistent), {}},
           {stiffness(fem::Tangent::Projected), {}}}};
}

}  // namespace

int main(int argc, char** argv) {
  const int cells = argc > 1 ? std::atoi(argv[1]) : 12;
  if (cells < 1 || argc > 2) {
    std::fprintf(stderr, "usage: law_speed [CELLS]\n");
    return 2;
  }
  const double side = 0.1;
  const fem::TetMesh mesh = fem::box_mesh({cells, cells, cells}, Vec3::Constant(side), 0.1);
  const Positions x =
      mesh.X + 0.05 * side / cells * fem::Random().matrix<Positions>(3, mesh.X.cols());
  std::deque<Row> rows;
  for (const fem::LawExample& law : fem::all_laws()) {
    rows.push_back(plain_row(law, mesh, x));
    rows.push_back(smoothed_row(law, mesh, x));
  }
  for (int round = 0; round < kRounds; ++round)
    for (Row& row : rows)
      for (Work& work : row.columns) work.time();
  std::printf(
      "%d tetrahedra, ns an element\n\n"
      "| Law | energy | force | stiffness | projected |\n"
      "| --- | --- | --- | --- | --- |\n",
      static_cast<int>(mesh.tets.cols()));
  for (const Row& row : rows) {
    std::printf("| %s |", row.name.c_str());
    for (const Work& work : row.columns)
      std::printf(" %.0f |", 1e9 * median(work.seconds) / static_cast<double>(mesh.tets.cols()));
    std::printf("\n");
  }
}
