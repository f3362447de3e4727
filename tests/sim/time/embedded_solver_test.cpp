// What ARKODE makes of a linear solver of our own.
#include <gtest/gtest.h>

#include <stdexcept>

#include "sim/time/arkode.hpp"

namespace articular::sim::embedded_solver_test {

using sundials::guarded_solve;
using sundials::view;

/// What a solve does.
enum class Solve { Solves, Fails, Throws };

/// y' = −y by one step of implicit Euler.
struct Decay {
  Solve solve;
  std::exception_ptr error{};
  sundials::Context context = sundials::make_context();
  sundials::Vector y = sundials::make_vector(1, context);
  sundials::Solver solver = sundials::make_solver(
      context, this, [](SUNLinearSolver) { return SUNLINEARSOLVER_MATRIX_EMBEDDED; },
      [](SUNLinearSolver of, SUNMatrix, N_Vector x, N_Vector b, realtype) {
        auto& self = *static_cast<Decay*>(of->content);
        return guarded_solve(self.error, [&] {
          if (self.solve == Solve::Throws) throw std::runtime_error("no");
          view(x) = view(b) / (1 + kStep);
          return self.solve == Solve::Solves;
        });
      });
  sundials::Arkode arkode{};

  static constexpr double kStep = 0.5;

  explicit Decay(Solve what) : solve(what) {
    view(y)[0] = 1;
    arkode.reset(ARKStepCreate(
        nullptr,
        [](realtype, N_Vector at, N_Vector rate, void*) {
          view(rate) = -view(at);
          return 0;
        },
        0, y.get(), context.get()));
    ARKStepSetErrHandlerFn(arkode.get(), sundials::ignore_message, nullptr);
    ARKStepSetOrder(arkode.get(), 2);
    ARKStepSStolerances(arkode.get(), 1e-6, 1e-6);
    ARKStepSetLinearSolver(arkode.get(), solver.get(), nullptr);
    ARKStepSetMaxConvFails(arkode.get(), 1);
    ARKStepSetFixedStep(arkode.get(), kStep);
  }

  /// @return whether it went on
  bool step() {
    double reached = 0;
    return ARKStepEvolve(arkode.get(), kStep, y.get(), &reached, ARK_ONE_STEP) >= 0 && !error;
  }
};

TEST(EmbeddedSolver, AStepWhoseEquationsAreNotSolvedFails) {
  EXPECT_TRUE(Decay(Solve::Solves).step());
  EXPECT_FALSE(Decay(Solve::Fails).step());
}

TEST(EmbeddedSolver, WhatItThrowsIsKept) {
  Decay decay(Solve::Throws);
  EXPECT_FALSE(decay.step());
  EXPECT_THROW(sundials::rethrow(decay.error), std::runtime_error);
}

}  // namespace articular::sim::embedded_solver_test
