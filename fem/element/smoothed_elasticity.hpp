#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "fem/base/tangent.hpp"
#include "fem/base/types.hpp"
#include "fem/element/dilatation_means.hpp"
#include "fem/element/stencil_batches.hpp"
#include "fem/element/stencil_pairs.hpp"
#include "fem/mesh/edge_domains.hpp"
#include "fem/mesh/tetrahedron.hpp"
#include "fem/simd/batched_law.hpp"
#include "fem/sparse/block_matrix.hpp"
#include "fem/sparse/nodal_pressure.hpp"
#include "fem/sparse/pressure_gradient.hpp"

namespace articular::fem {

struct AnyMaterial;  // any_material.hpp

/// The numbers of the formulation. Larger ones are stiffer and smoother (plain_share, active_bulk)
/// or softer (tau). The first two have the most margin in tests/benchmarks/fem/locking_study.cpp;
/// for the third see `scenarios/mandible/RESULTS.md`.
struct Smoothing {
  double plain_share = 0.1;  // s [-], in [0, 1]: part of the distortion taken by tetrahedra alone
  double tau = 2;            // τ [-], > 0: weight of the pressure's stabilisation
  double active_bulk = 2;    // α [-], not negative: of κ' by the active stress
};

/// Elastic energy, internal force and stiffness of linear tetrahedra that do not lock: distortion
/// smoothed over edges, and a nodal pressure (see edge_domains.hpp, nodal_pressure.hpp),
///
///   W(x) = (1 − s) Σ_k V_k Ψ_d(F_k) + s Σ_e V_e Ψ_d(F_e) + ½ bᵀA⁻¹b,   b_c = Σ_e V_e/4 Θ(F_e),
///
/// k edges, e elements, c pressures. Its derivatives, with the nodal pressure p = A⁻¹ b [Pa], p_e
/// the mean of the corners and G = ∂b/∂xᵀ:
///
///   f = f_d + G p,   ∂f/∂x = K + G A⁻¹ Gᵀ,   K = K_d + Σ_e V_e p_e ∂²Θ/∂x²
///
/// A nodal pressure lets elements around a node grow and shrink by turns. Only their distortion
/// resists, and fibres whose stress changes from element to element push them that way. So active
/// fibres add
///
///   ½ κ' Σ_k Σ_e V_e/6 (Θ_e − Θ̄_k)²,   κ' = α a σ_max,
///
/// e around edge k and Θ̄_k the mean of their Θ_e by volume: nothing where Θ is the same everywhere.
/// It is a pressure κ' (Θ_e − Σ_k Θ̄_k/6) of each element of its own. Stabilised nodal integration
/// keeps single elements in a like way [Puso, Solberg 2006, Int. J. Numer. Meth. Engng 67].
///
/// K has the pattern of the edges' stencils. The full second part couples all nodes and is only
/// applied by its factors (pressure_term.hpp).
///
/// Near ν = 0.5 the bulk modulus makes p(x) a steep function, and Newton's method in x alone takes
/// ever shorter steps. The functions with a p take the pressure as an unknown of its own: see
/// predicted_pressure().
///
/// Domains and elements go through the laws and the loops of assembly eight at a time
/// (point_kernels.hpp, stencil_kernels.hpp). Sums have a fixed order: the same bits in every run
/// with the same instruction set, which should be one that the machine has.
///
/// Holds work memory: one object serves one thread at a time.
class SmoothedElasticity {
 public:
  /// @throws std::invalid_argument as Elasticity does, and where `smoothing` is out of range
  SmoothedElasticity(const Positions& X, const Tetrahedra& tets, const AnyMaterial& material,
                     const Smoothing& smoothing = {}, FibreDirections fibres = {},
                     InstructionSet instruction_set = best_instruction_set());
  /// @param material_of_element  index into `materials`, one an element
  /// @param fibres               one an element where a material has fibres. A domain has the mean
  ///                             of its elements (mean_fibres)
  SmoothedElasticity(const Positions& X, const Tetrahedra& tets, std::vector<AnyMaterial> materials,
                     std::vector<int> material_of_element, const Smoothing& smoothing = {},
                     FibreDirections fibres = {},
                     InstructionSet instruction_set = best_instruction_set());

  int num_nodes() const { return num_nodes_; }
  int num_elements() const { return static_cast<int>(volume_.size()); }
  int num_pressures() const { return pressure_.size(); }
  const Tetrahedra& tets() const { return tets_; }
  const std::vector<double>& rest_volume() const { return volume_; }  // [m³], one an element
  const FibreDirections& fibres() const { return fibres_; }           // one an element, or none
  const FibreDirections& domain_fibres() const { return domain_fibres_; }  // one a domain, or none
  const Smoothing& smoothing() const { return smoothing_; }
  const EdgeDomains& domains() const { return domains_; }
  const NodalPressure& nodal_pressure() const { return pressure_; }
  const StencilBatches& stencils() const { return stencils_; }

  /// W [J]
  double energy(const Positions& x, double activation = 0) const;
  /// f += ∂W/∂x [N]: the force needed to hold the shape.
  void add_internal_force(const Positions& x, Positions& f, double activation = 0) const;
  /// p = A⁻¹ b(x) [Pa], positive in tension
  void pressure(const Positions& x, Eigen::VectorXd& p) const;

  /// The same with p as an unknown: L(x, p) = W_d(x) + pᵀb(x) − ½ pᵀA p, which is W at p = A⁻¹
  /// b(x). Up to the constant ½ pᵀA p that no step in x changes.
  double energy(const Positions& x, const Eigen::VectorXd& p, double activation = 0) const;
  /// f += ∂L/∂x = f_d + G p
  void add_internal_force(const Positions& x, const Eigen::VectorXd& p, Positions& f,
                          double activation = 0) const;
  /// p = A⁻¹ (b(x) + Gᵀ dx): the pressure after the step dx to first order. Newton's method in (x,
  /// p) solves (K(x, p) + G A⁻¹ Gᵀ) dx = f_ext − f_int(x) and goes to x + dx with this p.
  void predicted_pressure(const Positions& x, const PressureGradient& G, const Positions& dx,
                          Eigen::VectorXd& p) const;

  /// A matrix with the pattern of K: one block row a node.
  BlockMatrix make_matrix() const;
  /// K += scale * (∂²W_d/∂x² + Σ_e V_e p_e ∂²Θ/∂x²) [N/m], for a K of make_matrix().
  /// @param p  from pressure() or predicted_pressure()
  void add_stiffness(const Positions& x, const Eigen::VectorXd& p, Tangent tangent, double scale,
                     BlockMatrix& K, double activation = 0) const;
  /// For preconditioners: the pattern of the elements alone, a third of the blocks, and the
  /// stiffness of the distortion in it (s = 1, without the pressure's geometric part, which can be
  /// negative).
  BlockMatrix make_plain_matrix() const;
  void add_plain_stiffness(const Positions& x, Tangent tangent, double scale, BlockMatrix& K,
                           double activation = 0) const;
  /// For preconditioners that do not know the pressure, such as multigrid: K gains the resistance
  /// to changes of volume of a material with ν = 0.3, or of this one if it has less,
  /// κ' ∂Θ/∂F ⊗ ∂Θ/∂F with κ' = min(κ, 13/6 μ).
  void add_compressible_stiffness(const Positions& x, double scale, BlockMatrix& K) const;
  /// The pattern of G, and G(x) itself.
  PressureGradient make_pressure_gradient() const;
  void set_pressure_gradient(const Positions& x, PressureGradient& G) const;

  /// Per element, for output: means of the stress of the six edges' distortion, and the nodal
  /// pressures' mean. cauchy_stress: 6 x M (xx yy zz xy yz xz) [Pa].
  Eigen::MatrixXd cauchy_stress(const Positions& x, double activation = 0) const;
  Eigen::VectorXd volume_ratio(const Positions& x) const;  // J
  /// Where there are fibres; from their free length.
  Eigen::VectorXd fibre_stretch(const Positions& x) const;
  /// [J/m³]; sums to energy(x, activation)
  Eigen::VectorXd strain_energy_density(const Positions& x, double activation = 0) const;

 private:
  template <class Function>
  void for_each_domain(const Positions& x, double activation, Function function) const;
  template <class Function>
  void for_each_element(const Positions& x, double activation, Function function) const;
  Mat3 gradient_of_domain(const Positions& x, int k) const;
  double mean_pressure(int e, const Eigen::VectorXd& p) const;
  /// Eight domains or elements on their way through a loop.
  struct Octet {
    const BatchedLaw& law;
    int index;  // among the batches of stencils_
    StencilBatch batch;
    EightPoints points;
    BatchedLaw::Fibres fibres;
  };
  template <class Function>
  void for_each_domain_octet(const StencilBatches::Chunk& chunk, const Positions& x,
                             double activation, Function function) const;
  template <class Pressure, class Function>
  void for_each_element_octet(const StencilBatches::Chunk& chunk, const Positions& x, double share,
                              Pressure pressure, double activation, Function function) const;
  template <class Function>
  void for_each_octet(const Positions& x, const Eigen::VectorXd& p, double own_part,
                      double activation, Function function) const;
  double own_bulk(int material, double activation) const;
  bool has_own_bulk(double activation) const;
  void set_own_pressures(const Positions& x, double activation) const;
  const Eight* element_pressures(int i, const Eigen::VectorXd& p, double own_part,
                                 Eight& memory) const;
  void add_stiffness_of_means(const Positions& x, double scale, BlockMatrix& K,
                              double activation) const;
  static void add_bulk_tangent(const Octet& octet, double bulk, Eight* C);
  void add_stiffness(const Octet& octet, double bulk, Tangent tangent, double scale,
                     const StencilPairs& pairs, const PairSums& sums) const;
  template <class Function>
  void for_each_dilatation(const Positions& x, Function function) const;
  void dilatation(const Positions& x, Eigen::VectorXd& b) const;

  int num_nodes_ = 0;
  Tetrahedra tets_;
  std::shared_ptr<const std::vector<AnyMaterial>> materials_;
  std::vector<int> material_of_element_;
  Smoothing smoothing_;
  FibreDirections fibres_, domain_fibres_;  // one a tetrahedron, one a domain; or none
  std::vector<Mat3> inverse_edges_;         // (X1-X0, X2-X0, X3-X0)⁻¹ [1/m]
  std::vector<double> volume_;              // [m³]
  std::vector<int> elements_;               // ordered by material
  std::vector<int> element_begin_;          // of each material, into elements_
  EdgeDomains domains_;
  NodalPressure pressure_;

  InstructionSet instruction_set_;
  StencilBatches stencils_;
  StencilPairs pairs_, plain_pairs_;          // in the two matrices
  std::vector<EightIndices> gradient_slots_;  // 16 a batch of elements, 4a + c, into G
  mutable Eigen::VectorXd p_work_;

  // Of tissue with active fibres.
  std::optional<DilatationMeans> means_;
  mutable Eigen::VectorXd own_pressure_;  // [Pa], one an element
  mutable std::vector<Mat34> slope_;      // V_e ∂Θ_e/∂x [m²], one an element
  mutable std::vector<double> factor_;    // one a material
};

}  // namespace articular::fem
