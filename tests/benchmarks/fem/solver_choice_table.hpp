#pragma once

namespace articular::benchmarks {

/// A table of solvers on one cube: plain and smoothed tetrahedra, statics and steps in time, and
/// what fem::choose_solver() takes. @param most_cells  along an edge
void print_solver_choices(int most_cells);

}  // namespace articular::benchmarks
