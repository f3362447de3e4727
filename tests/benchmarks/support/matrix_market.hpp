#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>

#include "fem/sparse/block_matrix.hpp"
#include "fem/sparse/pressure_term.hpp"

/// Files in Matrix Market's form, for other programs. Numbers have all their digits.
/// @throws std::system_error  where a file can't be written
namespace articular::benchmarks {

/// Symmetric: its lower half.
void write_matrix(const std::filesystem::path& path, const fem::BlockMatrix& A);
/// By columns, all of it.
void write_matrix(const std::filesystem::path& path, const Eigen::MatrixXd& A);
/// G of all terms beside each other: as many columns as there are pressures.
void write_gradients(const std::filesystem::path& path, std::span<const fem::PressureTerm> terms);
/// A/scale of all terms one below the other: symmetric, its lower half.
void write_compliances(const std::filesystem::path& path, std::span<const fem::PressureTerm> terms);

}  // namespace articular::benchmarks
