#include "fem/elasticity.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "fem/parallel_parts.hpp"
#include "fem/tetrahedron.hpp"

namespace articular::fem {
namespace {

// An element counts as flat below this volume relative to its longest edge cubed (a regular one has
// 0.12). Rounding of the coordinates alone puts about 1e-16 there; 1e-12 leaves four digits of the
// volume, and a stiffness that is no more than about 1e12 times that of its neighbours.
constexpr double kFlat = 1e-12;  // [-]

// A tangent whose lowest eigenvalue lies above minus this part of its norm is positive semidefinite
// up to round-off: rigid rotations put zeros there.
constexpr double kRoundOff = 1e-13;  // [-]

Mat34 gather(const Positions& x, const Eigen::Vector4i& nodes) {
  Mat34 x_e;
  for (int a = 0; a < 4; ++a) x_e.col(a) = x.col(nodes[a]);
  return x_e;
}

std::string name_of(const Tetrahedra& tets, Eigen::Index e) {
  std::ostringstream name;
  name << "tetrahedron " << e << " (nodes " << tets(0, e) << ' ' << tets(1, e) << ' ' << tets(2, e)
       << ' ' << tets(3, e) << ')';
  return name.str();
}

/// Volume of element e [m³]. @throws std::invalid_argument unless it is positive and not flat
double checked_volume(const Positions& X, const Tetrahedra& tets, Eigen::Index e) {
  for (int a = 0; a < 4; ++a) {
    if (tets(a, e) < 0 || tets(a, e) >= X.cols()) {
      std::ostringstream message;
      message << name_of(tets, e) << " has a node out of range: there are " << X.cols() << " nodes";
      throw std::invalid_argument(message.str());
    }
  }
  const Mat34 X_e = gather(X, tets.col(e));
  const double volume = edge_matrix(X_e).determinant() / 6;
  double longest2 = 0;
  for (int a = 0; a < 4; ++a) {
    for (int b = a + 1; b < 4; ++b) {
      longest2 = std::max(longest2, (X_e.col(a) - X_e.col(b)).squaredNorm());
    }
  }
  const double smallest = kFlat * longest2 * std::sqrt(longest2);
  if (volume > smallest && std::isfinite(volume)) return volume;  // false for NaN
  std::ostringstream message;
  message << name_of(tets, e) << " is " << (volume < -smallest ? "inverted" : "flat")
          << ": its volume is " << volume << " m^3, must be above " << smallest
          << " m^3 (1e-12 of its longest edge cubed)";
  throw std::invalid_argument(message.str());
}

std::vector<double> checked_volumes(const Positions& X, const Tetrahedra& tets) {
  std::vector<double> volumes;
  volumes.reserve(static_cast<std::size_t>(tets.cols()));
  for (Eigen::Index e = 0; e < tets.cols(); ++e) volumes.push_back(checked_volume(X, tets, e));
  return volumes;
}

/// Each node has its own block row.
std::vector<int> every_node(int num_nodes) {
  std::vector<int> blocks(static_cast<std::size_t>(num_nodes));
  std::iota(blocks.begin(), blocks.end(), 0);
  return blocks;
}

std::optional<BatchLaw> batch_law(const Material& material) {
  return std::visit(
      []<class M>(const M& m) -> std::optional<BatchLaw> {
        if constexpr (Batched<M>) return m.batch_law();
        return std::nullopt;
      },
      material);
}

/// The nearest positive semidefinite matrix (in the Frobenius norm): eigenvalues below 0 become 0.
Mat9 projected(const Mat9& tangent) {
  const double round_off = kRoundOff * tangent.norm();
  const Eigen::LLT<Mat9> shifted(tangent + round_off * Mat9::Identity());
  if (shifted.info() == Eigen::Success) return tangent;
  const Eigen::SelfAdjointEigenSolver<Mat9> eigen(tangent);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
         eigen.eigenvectors().transpose();
}

template <Hyperelastic M>
Mat9 projected_tangent(const M& material, const Mat3& F) {
  if constexpr (requires { material.projected_tangent(F); }) {
    return material.projected_tangent(F);
  } else {
    return projected(material.tangent(F));
  }
}

/// Cauchy stress σ = P Fᵀ/J [Pa]; not finite where J = 0.
template <Hyperelastic M>
Mat3 cauchy(const M& material, const Mat3& F) {
  if constexpr (requires { material.cauchy_stress(F); }) {
    return material.cauchy_stress(F);
  } else {
    return material.first_piola(F) * F.transpose() / F.determinant();
  }
}

}  // namespace

Elasticity::Elasticity(const Positions& X, const Tetrahedra& tets, Material material,
                       AssemblyOptions options)
    : num_nodes_(static_cast<int>(X.cols())),
      tets_(tets),
      material_(std::move(material)),
      options_(options),
      volume_(checked_volumes(X, tets)),
      elements_(X, tets_, volume_),
      slots_(elements_, make_matrix(), every_node(num_nodes_)) {}

/// Calls function(material, place, F) for the elements of a chunk in their order; the material is
/// chosen once.
template <class Function>
void Elasticity::for_each_element(int chunk, const Positions& x, Function function) const {
  const Chunk& places = elements_.chunk(chunk);
  std::visit(
      [&](const auto& material) {
        for (int place = places.begin; place < places.end; ++place) {
          const Mat34 x_e = gather(x, elements_.nodes(place));
          function(material, place, deformation_gradient(x_e, elements_.inverse_edges(place)));
        }
      },
      material_);
}

/// The same for all elements. What the function writes belongs to the element, or to its nodes.
template <class Function>
void Elasticity::for_each_element(const Positions& x, Function function) const {
  assert(x.cols() == num_nodes_);
  for_each_chunk(elements_, options_.threads,
                 [&](int, int chunk) { for_each_element(chunk, x, function); });
}

ChunkJob Elasticity::job(const BatchLaw& law, const Positions& x, int chunk) const {
  const Chunk& places = elements_.chunk(chunk);
  ChunkJob job{};
  job.batches = &elements_.batches()[static_cast<std::size_t>(places.begin / kBatchSize)];
  job.num_elements = places.end - places.begin;
  job.mu = law.mu;
  job.lambda = law.lambda;
  job.x = x.data();
  return job;
}

double Elasticity::energy(const Positions& x) const {
  assert(x.cols() == num_nodes_);
  const std::optional<BatchLaw> law = batch_law(material_);
  std::array<double, ElementBatches::kInnerParts + 1> W{};  // of each part
  for_each_chunk(elements_, options_.threads, [&](int part, int chunk) {
    double& W_part = W[static_cast<std::size_t>(part)];
    if (law) {
      const LawKernels& kernels = element_kernels(options_.instruction_set, law->kind);
      W_part += kernels.energy(job(*law, x, chunk));
    } else {
      for_each_element(chunk, x, [&](const auto& material, int place, const Mat3& F) {
        W_part += elements_.volume(place) * material.energy_density(F);
      });
    }
  });
  return std::accumulate(W.begin(), W.end(), 0.0);
}

void Elasticity::add_internal_force(const Positions& x, Positions& f) const {
  assert(x.cols() == num_nodes_);
  assert(f.cols() == num_nodes_);
  for_each_chunk(elements_, options_.threads, [&](int, int chunk) { add_force(chunk, x, f); });
}

void Elasticity::add_force(int chunk, const Positions& x, Positions& f) const {
  if (const std::optional<BatchLaw> law = batch_law(material_)) {
    ChunkJob work = job(*law, x, chunk);
    work.f = f.data();
    return element_kernels(options_.instruction_set, law->kind).force(work);
  }
  for_each_element(chunk, x, [&](const auto& material, int place, const Mat3& F) {
    const Mat34 dN_dX = shape_gradients(elements_.inverse_edges(place));
    const Mat34 f_e = nodal_force(material.first_piola(F), dN_dX, elements_.volume(place));
    const Eigen::Vector4i nodes = elements_.nodes(place);
    for (int a = 0; a < 4; ++a) f.col(nodes[a]) += f_e.col(a);
  });
}

BlockMatrix Elasticity::make_matrix() const {
  std::vector<int> offsets(volume_.size() + 1);
  for (std::size_t e = 0; e < offsets.size(); ++e) offsets[e] = static_cast<int>(4 * e);
  return {num_nodes_, {tets_.data(), 4 * volume_.size()}, offsets};
}

StiffnessSlots Elasticity::slots_in(const BlockMatrix& A,
                                    std::span<const int> block_of_node) const {
  assert(static_cast<int>(block_of_node.size()) == num_nodes_);
  return {elements_, A, block_of_node};
}

void Elasticity::add_stiffness(const Positions& x, Tangent tangent, double scale,
                               BlockMatrix& K) const {
  add(x, tangent, scale, slots_, nullptr, K);
}

void Elasticity::add_stiffness(const Positions& x, Tangent tangent, double scale,
                               const StiffnessSlots& slots, BlockMatrix& A) const {
  add(x, tangent, scale, slots, nullptr, A);
}

void Elasticity::add_force_and_stiffness(const Positions& x, Tangent tangent, double scale,
                                         const StiffnessSlots& slots, Positions& f,
                                         BlockMatrix& A) const {
  assert(f.cols() == num_nodes_);
  add(x, tangent, scale, slots, &f, A);
}

/// The stiffness, and the force where f is not null.
void Elasticity::add(const Positions& x, Tangent tangent, double scale, const StiffnessSlots& slots,
                     Positions* f, BlockMatrix& A) const {
  assert(x.cols() == num_nodes_);
  assert(A.pattern_id() == slots.pattern_id());
  const bool projected = tangent == Tangent::Projected;
  if (const std::optional<BatchLaw> law = batch_law(material_)) {
    const LawKernels& kernels = element_kernels(options_.instruction_set, law->kind);
    const auto stiffness = projected ? kernels.projected_stiffness : kernels.stiffness;
    const auto both =
        projected ? kernels.force_and_projected_stiffness : kernels.force_and_stiffness;
    for_each_chunk(elements_, options_.threads, [&](int, int chunk) {
      ChunkJob work = job(*law, x, chunk);
      slots.describe(chunk, work);
      work.f = f == nullptr ? nullptr : f->data();
      work.scale = scale;
      work.K = A.values();
      (f == nullptr ? stiffness : both)(work);
    });
    return;
  }
  for_each_chunk(elements_, options_.threads, [&](int, int chunk) {
    if (f != nullptr) add_force(chunk, x, *f);
    for_each_element(chunk, x, [&](const auto& material, int place, const Mat3& F) {
      const Mat9 C = projected ? projected_tangent(material, F) : material.tangent(F);
      const Mat12 K_e = stiffness(C, shape_gradients(elements_.inverse_edges(place)),
                                  scale * elements_.volume(place));
      slots.add(chunk, place, K_e, A);
    });
  });
}

Eigen::MatrixXd Elasticity::cauchy_stress(const Positions& x) const {
  Eigen::MatrixXd stress(6, num_elements());
  for_each_element(x, [&](const auto& material, int place, const Mat3& F) {
    const Mat3 s = cauchy(material, F);
    stress.col(elements_.element(place)) << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2);
  });
  return stress;
}

Eigen::VectorXd Elasticity::von_mises(const Positions& x) const {
  Eigen::VectorXd result(num_elements());
  for_each_element(x, [&](const auto& material, int place, const Mat3& F) {
    const Mat3 sigma = cauchy(material, F);
    const Mat3 deviator = sigma - sigma.trace() / 3 * Mat3::Identity();
    result[elements_.element(place)] = std::sqrt(1.5) * deviator.norm();
  });
  return result;
}

Eigen::VectorXd Elasticity::volume_ratio(const Positions& x) const {
  Eigen::VectorXd result(num_elements());
  for_each_element(x, [&](const auto&, int place, const Mat3& F) {
    result[elements_.element(place)] = F.determinant();
  });
  return result;
}

Eigen::VectorXd Elasticity::strain_energy_density(const Positions& x) const {
  Eigen::VectorXd result(num_elements());
  for_each_element(x, [&](const auto& material, int place, const Mat3& F) {
    result[elements_.element(place)] = material.energy_density(F);
  });
  return result;
}

Eigen::VectorXd lumped_mass(const Positions& X, const Tetrahedra& tets, double density) {
  if (!(density > 0) || !std::isfinite(density)) {
    std::ostringstream message;
    message << "density is " << density << " kg/m^3, must be positive and finite";
    throw std::invalid_argument(message.str());
  }
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(X.cols());
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    const double quarter = density * checked_volume(X, tets, e) / 4;
    for (int a = 0; a < 4; ++a) mass[tets(a, e)] += quarter;
  }
  return mass;
}

}  // namespace articular::fem
