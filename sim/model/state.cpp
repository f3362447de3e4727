#include "sim/model/state.hpp"

namespace articular::sim {
namespace {

template <class Operation>
SolverCounts combined(SolverCounts a, const SolverCounts& b, Operation operation) {
  for (std::int64_t SolverCounts::*count :
       {&SolverCounts::steps, &SolverCounts::rejected_newton, &SolverCounts::newton_iterations,
        &SolverCounts::factorizations, &SolverCounts::projected_tangents,
        &SolverCounts::linear_solves, &SolverCounts::linear_iterations,
        &SolverCounts::force_evaluations})
    a.*count = operation(a.*count, b.*count);
  return a;
}

}  // namespace

SolverCounts operator+(SolverCounts a, const SolverCounts& b) {
  return combined(a, b, [](auto x, auto y) { return x + y; });
}
SolverCounts operator-(SolverCounts a, const SolverCounts& b) {
  return combined(a, b, [](auto x, auto y) { return x - y; });
}

}  // namespace articular::sim
