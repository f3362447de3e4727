#pragma once

#include <memory>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/element/smoothed_elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "fem/solver/linear_solver.hpp"
#include "tests/fem/support/box_mesh.hpp"

namespace articular::fem {

/// (m + K + G C⁻¹ Gᵀ) u = b of a box of smoothed tetrahedra that is clamped at x = 0, whose nodes
/// have rows of a diagonal matrix, and pulled along z.
struct SmoothedBox {
  Positions x;
  std::unique_ptr<SmoothedElasticity> elasticity;
  BlockMatrix K, plain;
  PressureGradient G;
  Eigen::VectorXd b;
  std::vector<PressureTerm> terms;

  /// Views of this box.
  PressurePart part() {
    terms.assign(1, {.G = &G, .pressure = &elasticity->nodal_pressure(), .scale = 1});
    return {.terms = terms, .plain = &plain};
  }
};

constexpr double kModulusOfBox = 1e6;  // Young's modulus [Pa]

/// What SmoothedBox::plain is: the stiffness of the distortion alone, or with the resistance to
/// changes of volume that multigrid does better with.
enum class PlainPart { Distortion, Compressible };

inline void hold_node(int node, BlockMatrix& K) {
  for (int s = K.row_begin()[node]; s < K.row_begin()[node + 1]; ++s) {
    const int j = K.column()[s];
    if (j == node) {
      K.block(s) = K.block(s)(0, 0) * Mat3::Identity();
    } else {
      K.block(s).setZero();
      K.block(K.slot(j, node)).setZero();
    }
  }
}

/// @param inertia  m = ρ/dt² relative to μ/L², L the longest side: 0 in statics
/// @param inside   Young's modulus of the middle part, relative to that of the others
inline SmoothedBox smoothed_box(const TetMesh& mesh, double nu, double inertia = 0,
                                PlainPart plain = PlainPart::Compressible, double inside = 1) {
  constexpr double kE = kModulusOfBox;
  SmoothedBox box;
  const double mu = lame_parameters(kE, nu).mu;
  const Vec3 low = mesh.X.rowwise().minCoeff(), high = mesh.X.rowwise().maxCoeff();
  std::vector<int> material(static_cast<std::size_t>(mesh.tets.cols()), 0);
  for (int e = 0; e < mesh.tets.cols(); ++e) {
    Vec3 center = Vec3::Zero();
    for (const int node : mesh.tets.col(e)) center += 0.25 * mesh.X.col(node);
    const Vec3 from_middle = (center - 0.5 * (low + high)).cwiseQuotient(high - low);
    if (inside != 1 && from_middle.lpNorm<Eigen::Infinity>() < 0.25) material[e] = 1;
  }
  box.elasticity = std::make_unique<SmoothedElasticity>(
      mesh.X, mesh.tets, std::vector<AnyMaterial>{NeoHookean(kE, nu), NeoHookean(inside * kE, nu)},
      material);
  box.x = mesh.X;
  box.K = box.elasticity->make_matrix();
  box.plain = box.elasticity->make_plain_matrix();
  box.G = box.elasticity->make_pressure_gradient();
  Eigen::VectorXd p;
  box.elasticity->pressure(box.x, p);
  box.elasticity->add_stiffness(box.x, p, Tangent::Projected, 1, box.K);
  box.elasticity->set_pressure_gradient(box.x, box.G);
  box.elasticity->add_plain_stiffness(box.x, Tangent::Projected, 1, box.plain);
  if (plain == PlainPart::Compressible)
    box.elasticity->add_compressible_stiffness(box.x, 1, box.plain);
  const double length = (high - low).maxCoeff();
  const Eigen::VectorXd volume = lumped_mass(mesh.X, mesh.tets, 1);
  box.b.setZero(mesh.X.size());
  for (int i = 0; i < mesh.X.cols(); ++i) {
    for (BlockMatrix* matrix : {&box.K, &box.plain}) {
      matrix->block(matrix->slot(i, i)).diagonal().array() +=
          inertia * mu / (length * length) * volume[i];
      if (mesh.X(0, i) == 0) hold_node(i, *matrix);
    }
    if (mesh.X(0, i) == 0) {
      box.G.set_row_zero(i);
    } else {
      box.b[3 * i + 2] = volume[i];
    }
  }
  return box;
}

/// The same system of plain tetrahedra, without pressures.
inline BlockMatrix plain_box(const TetMesh& mesh, double nu, double inertia) {
  const Elasticity elasticity(mesh.X, mesh.tets, NeoHookean(kModulusOfBox, nu));
  BlockMatrix K = elasticity.make_matrix();
  elasticity.add_stiffness(mesh.X, Tangent::Projected, 1, K);
  const double length = (mesh.X.rowwise().maxCoeff() - mesh.X.rowwise().minCoeff()).maxCoeff();
  const Eigen::VectorXd volume = lumped_mass(mesh.X, mesh.tets, 1);
  const double mu = lame_parameters(kModulusOfBox, nu).mu;
  for (int i = 0; i < mesh.X.cols(); ++i) {
    K.block(K.slot(i, i)).diagonal().array() += inertia * mu / (length * length) * volume[i];
    if (mesh.X(0, i) == 0) hold_node(i, K);
  }
  return K;
}

}  // namespace articular::fem
