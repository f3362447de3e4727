#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/benchmarks/fem/domain_elasticity.hpp"

/// The parts of tests/benchmarks/fem/locking_study.cpp.
namespace articular::fem {

/// The neo-Hookean material of all problems but the beam: μ [MPa] and its κ for ν.
constexpr double kMu = 80.1938;
MooneyRivlin<> study_material(double nu, double mu = kMu);

/// A formulation by its name in the tables, made for one mesh and one material.
struct Candidate {
  std::string name;
  bool smoothed;                                                            // with nodal pressure
  Smoothing smoothing{};                                                    // if it is
  DomainElasticity::Domains domains = DomainElasticity::Domains::Elements;  // if not
};
std::vector<Candidate> candidates();
const Candidate& candidate(const std::string& name);

/// Formulation with what it refers to.
class Body {
 public:
  Body(const Candidate& candidate, const TetMesh& mesh, const MooneyRivlin<>& material);
  Formulation formulation() const;
  double pressure_roughness(const Positions& x) const;

 private:
  std::unique_ptr<SmoothedElasticity> smoothed_;
  std::unique_ptr<DomainElasticity> domains_;
};

struct Equilibrium {
  Positions x;
  double displacement;  // of the probe; NaN where Newton's method did not converge
  NewtonReport report;
};
Equilibrium equilibrium_of(const Body& body, const LoadedBody& loaded,
                           const NewtonSettings& settings = {.tolerance = 1e-7,
                                                             .max_iterations = 200});

void print_accuracy();
void print_meshes();
void print_newton();
void print_modes();
void print_cost();
void print_curves();
void print_fibres();

}  // namespace articular::fem
