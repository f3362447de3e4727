#pragma once

#include <filesystem>

namespace articular::benchmarks {

/// What each integrator does to energy and momentum that nothing takes: a beam that swings freely
/// and a body that tumbles freely. Prints Markdown tables; energy.csv in `out` has the curves.
void study_energy(const std::filesystem::path& program, const std::filesystem::path& out);

}  // namespace articular::benchmarks
