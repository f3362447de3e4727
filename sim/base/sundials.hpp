#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>

#include <Eigen/Core>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

/// What the files that call SUNDIALS share: owners of its handles, and a way for exceptions around
/// its C callbacks.
namespace articular::sim::sundials {

static_assert(std::is_same_v<realtype, double>);

struct FreeContext {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct FreeVector {
  void operator()(N_Vector v) const { N_VDestroy(v); }
};
struct FreeSolver {
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
};
template <class Handle, class Free>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Free>;
using Context = Owned<SUNContext, FreeContext>;
using Vector = Owned<N_Vector, FreeVector>;
using Solver = Owned<SUNLinearSolver, FreeSolver>;

inline void check(int flag, const char* call) {
  if (flag < 0) throw std::runtime_error(std::string(call) + " failed: " + std::to_string(flag));
}

inline Context make_context() {
  SUNContext context = nullptr;
  check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
  return Context(context);
}

/// A vector of zeros.
inline Vector make_vector(Eigen::Index size, const Context& context) {
  Vector vector(N_VNew_Serial(size, context.get()));
  N_VConst(0, vector.get());
  return vector;
}

inline Eigen::Map<Eigen::VectorXd> view(N_Vector v) {
  return {N_VGetArrayPointer(v), N_VGetLength(v)};
}
inline Eigen::Map<Eigen::VectorXd> view(const Vector& v) { return view(v.get()); }

inline void ignore_message(int, const char*, const char*, char*, void*) {}

/// Runs body() below a C callback; an exception becomes "stop" for SUNDIALS and is kept for the
/// caller above it.
template <class Body>
int guarded(std::exception_ptr& error, Body&& body) {
  try {
    return body();
  } catch (...) {
    error = std::current_exception();
    return -1;
  }
}

/// The same for a linear solver, by whether it solved: all but SUNDIALS' own codes of failure are
/// success to ARKODE.
template <class Body>
int guarded_solve(std::exception_ptr& error, Body&& body) {
  try {
    return body() ? SUNLS_SUCCESS : SUNLS_PACKAGE_FAIL_REC;
  } catch (...) {
    error = std::current_exception();
    return SUNLS_PACKAGE_FAIL_UNREC;
  }
}

/// Throws on what was kept.
inline void rethrow(std::exception_ptr& error) {
  if (error) std::rethrow_exception(std::exchange(error, nullptr));
}

/// A linear solver of our own behind SUNDIALS' interface.
/// @param content  handed to the functions
inline Solver make_solver(const Context& context, void* content,
                          SUNLinearSolver_Type (*type)(SUNLinearSolver),
                          int (*solve)(SUNLinearSolver, SUNMatrix, N_Vector, N_Vector, realtype)) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(context.get());
  solver->content = content;
  solver->ops->gettype = type;
  solver->ops->solve = solve;
  solver->ops->free = [](SUNLinearSolver s) {
    s->content = nullptr;
    SUNLinSolFreeEmpty(s);
    return 0;
  };
  return Solver(solver);
}

}  // namespace articular::sim::sundials
