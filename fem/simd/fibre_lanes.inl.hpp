#pragma once

// Part of point_kernels.inl.hpp: fibres in a polynomial ground substance (see
// transversely_isotropic.hpp and blemker_muscle.hpp), a register of points at once. The curves of
// the fibres are called point after point.

#include "fem/simd/isotropic_lanes.inl.hpp"

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

struct ValueSlopeCurvature {
  Lanes value, slope, curvature;
};

/// acosh²(y), by the series and the closed form of fibre_shear.hpp.
inline ValueSlopeCurvature squared_acosh(Lanes y) {
  constexpr int kTerms = 14;
  const Lanes z = y - 1;
  ValueSlopeCurvature near{};
  double coefficient[kTerms + 1];
  coefficient[1] = 2;
  for (int n = 2; n <= kTerms; ++n) {
    coefficient[n] = -coefficient[n - 1] * (n - 1.0) * (n - 1.0) / (n * (2.0 * n - 1));
  }
  for (int n = kTerms; n >= 1; --n) {
    near.value = (near.value + coefficient[n]) * z;
    near.slope = near.slope * z + n * coefficient[n];
    if (n > 1) near.curvature = near.curvature * z + n * (n - 1) * coefficient[n];
  }
  const Lanes s2 = y * y - 1, s = sqrt(s2), a = log(y + s);
  const Mask is_near = z < 0.1;
  return {is_near ? near.value : a * a, is_near ? near.slope : 2 * a / s,
          is_near ? near.curvature : 2 * (1 - y * a / s) / s2};
}

inline Lanes evaluate(FibreCurve::Function function, const FibreBatchLaw& law,
                      const FibreCurve& curve, Lanes stretch) {
  Lanes result;
  for (int lane = 0; lane < kWidth; ++lane) {
    result[lane] = function(curve.law, stretch[lane], law.activation);
  }
  return result;
}

/// kShear: it resists shear along and across the fibres by itself.
template <class Energy, class Theta, bool kShear>
struct FibreLanes {
  using Ground = IsotropicLanes<Energy, Theta>;
  Ground ground;
  const FibreBatchLaw& fibres;
  explicit FibreLanes(const SplitBatchLaw& law) : ground(law), fibres(law.fibres) {}

  struct State {
    typename Ground::State ground;
    Vector a, b, w;  // a unit vector along the fibre at rest, F a, Fᵀ F a
    Lanes density;   // of the fibres [-]
    Lanes I4, I5, stretch;
  };
  static State at(const Matrix& F, const EightPoints& points, int first) {
    State s;
    s.ground = Ground::at(F, points, first);
    const Vector fibre{load(points.fibre[0].lane + first), load(points.fibre[1].lane + first),
                       load(points.fibre[2].lane + first)};
    s.density = sqrt(dot(fibre, fibre));
    s.a = (1 / s.density) * fibre;
    s.b = F * s.a;
    s.w = transposed(F) * s.b;
    s.I4 = dot(s.b, s.b);
    s.I5 = dot(s.w, s.w);
    s.stretch = sqrt(s.I4);
    return s;
  }

  Lanes energy_density(const State& s) const {
    Lanes W = ground.energy_density(s.ground);
    if (s.ground.share == 0) return W;
    Lanes of_fibre{};
    for_each_curve(s, [&](const FibreCurve& curve, Lanes stretch, bool) {
      of_fibre += evaluate(curve.energy, fibres, curve, stretch);
    });
    W += s.ground.share * s.density * of_fibre;
    if constexpr (kShear) {
      const Lanes of_shear = fibres.shear_along * (s.I5 / (s.I4 * s.I4) - 1) +
                             fibres.shear_across * squared_acosh(cosh_B2(s)).value;
      W += s.ground.share * of_shear;
    }
    return W;
  }

  Matrix first_piola(const State& s) const {
    const FibreSlopes d = slopes(s);
    Matrix P = Ground::first_piola(s.ground, d.ground) + outer(s.b, (2 * d.I4) * s.a);
    if constexpr (kShear) P = P + d.I5 * fifth_invariant_gradient(s);
    return P;
  }

  /// The blocks are those of invariants.cpp. Of I4 and I5 they are
  ///   2 a_j a_l 1   and   2 (δ_jl b bᵀ + a_l b f_jᵀ + a_j f_l bᵀ + a_j a_l B + (w_j a_l + a_j w_l)
  ///   1).
  void tangent(const State& s, Tangent81& C) const {
    const FibreSlopes d = slopes(s);
    Ground::tangent(s.ground, d.ground, C);
    const Matrix &F = s.ground.F, &cof = s.ground.cof;
    const Matrix g4 = outer(s.b, all(2) * s.a);
    Matrix g5, FFt;
    if constexpr (kShear) {
      g5 = fifth_invariant_gradient(s);
      FFt = F * transposed(F);
    }
    for (int l = 0; l < 3; ++l) {
      Vector by_4 = d.I4_I4 * g4[l] + d.I4_J * cof[l], by_cof = d.I4_J * g4[l], by_5{}, by_F{};
      if constexpr (kShear) {
        by_4 = by_4 + (2 * d.I1_I4) * F[l] + d.I4_I5 * g5[l];
        by_5 = (2 * d.I1_I5) * F[l] + d.I4_I5 * g4[l] + d.I5_I5 * g5[l] + d.I5_J * cof[l];
        by_F = (2 * d.I1_I4) * g4[l] + (2 * d.I1_I5) * g5[l];
        by_cof = by_cof + d.I5_J * g5[l];
      }
      for (int j = l; j < 3; ++j) {
        Matrix B = C.block[j + 3 * l] + outer(g4[j], by_4) + outer(cof[j], by_cof);
        Lanes on_diagonal = 2 * d.I4 * s.a[j] * s.a[l];
        if constexpr (kShear) {
          const Lanes c = 2 * d.I5;
          B = B + outer(g5[j], by_5) + outer(F[j], by_F) + outer((c * s.a[l]) * s.b, F[j]) +
              outer((c * s.a[j]) * F[l], s.b) + (c * s.a[j] * s.a[l]) * FFt;
          if (j == l) B = B + outer(c * s.b, s.b);
          on_diagonal += c * (s.w[j] * s.a[l] + s.a[j] * s.w[l]);
        }
        for (int k = 0; k < 3; ++k) B[k][k] += on_diagonal;
        C.block[j + 3 * l] = B;
        if (j != l) C.block[l + 3 * j] = transposed(B);
      }
    }
  }

  /// Positive semidefinite. An energy W(q) of q = J^(−1/3) λ has the second derivative
  ///   W'' q² ∇s ∇sᵀ + W' q [(1 − n nᵀ) ⊗ a aᵀ/λ² − ∂²ln J/3 + ∇s ∇sᵀ − ∇ln λ ∇ln λᵀ],  s = ln q,
  /// with n along F a. The last two cancel unless the volume changes, and are left out; the part of
  /// ln J is added to the ground's, whose nearest is taken. W' is not negative: fibres do not push.
  void projected_tangent(const State& s, Tangent81& C) const {
    Slopes ground_slopes = ground.slopes(s.ground);
    const Lanes zero{}, inverse_J = 1 / s.ground.i.J;
    Lanes along{}, isochoric_along{}, across{};
    if (s.ground.share != 0) {
      const Lanes number = s.ground.share * s.density;
      for_each_curve(s, [&](const FibreCurve& curve, Lanes q, bool is_isochoric) {
        const Lanes pull = number * evaluate(curve.tension, fibres, curve, q) * q;
        const Lanes stiffness = number * evaluate(curve.stiffness, fibres, curve, q) * q * q;
        (is_isochoric ? isochoric_along : along) += max(zero, stiffness);
        across += pull / s.I4;
        if (!is_isochoric) return;
        ground_slopes.J -= (1.0 / 3) * pull * inverse_J;
        ground_slopes.J_J += (1.0 / 3) * pull * inverse_J * inverse_J;
      });
    }
    Ground::projected_tangent(s.ground, ground_slopes, C);
    if constexpr (kShear) across += add_projected_shear(s, C);
    const Vector n = (1 / s.stretch) * s.b;
    const Matrix by_stretch = outer((1 / s.stretch) * n, s.a);
    add_square(along, by_stretch, C);
    add_square(isochoric_along, by_stretch - ((1.0 / 3) * inverse_J) * s.ground.cof, C);
    add_square(across, s.a, C);
    add_square(-across, outer(n, s.a), C);
    for (int l = 0; l < 3; ++l) {
      for (int j = l + 1; j < 3; ++j) C.block[l + 3 * j] = transposed(C.block[j + 3 * l]);
    }
  }

 private:
  /// Derivatives of the energy; those of I2 with the invariants of the fibre are zero.
  struct FibreSlopes {
    Slopes ground;
    Lanes I4{}, I5{}, I1_I4{}, I1_I5{}, I4_I4{}, I4_I5{}, I4_J{}, I5_I5{}, I5_J{};
  };

  /// λ̄
  static Lanes isochoric_stretch(const State& s) {
    return inverse_cube_root(s.ground.i.J) * s.stretch;
  }

  /// Calls use(curve, stretch, is_isochoric) for the curves that there are.
  template <class Use>
  void for_each_curve(const State& s, const Use& use) const {
    if (fibres.of_stretch.law != nullptr) use(fibres.of_stretch, s.stretch, false);
    if (fibres.of_isochoric_stretch.law != nullptr)
      use(fibres.of_isochoric_stretch, isochoric_stretch(s), true);
  }

  FibreSlopes slopes(const State& s) const {
    FibreSlopes d;
    d.ground = ground.slopes(s.ground);
    if (s.ground.share == 0) return d;
    const Lanes share = s.ground.share * s.density;
    for_each_curve(s, [&](const FibreCurve& curve, Lanes stretch, bool is_isochoric) {
      const Lanes tension = share * evaluate(curve.tension, fibres, curve, stretch);
      const Lanes stiffness = share * evaluate(curve.stiffness, fibres, curve, stretch);
      add_stretch(s, stretch, tension, stiffness, is_isochoric, d);
    });
    if constexpr (kShear) add_shear(s, d);
    return d;
  }

  /// Of a term W(q) with q = √I4, or q = J^(−1/3) √I4.
  static void add_stretch(const State& s, Lanes q, Lanes tension, Lanes stiffness,
                          bool is_isochoric, FibreSlopes& d) {
    const Lanes by_4 = 0.5 * q / s.I4;
    d.I4 += tension * by_4;
    d.I4_I4 += (stiffness * by_4 - 0.5 * tension / s.I4) * by_4;
    if (!is_isochoric) return;
    const Lanes inverse_J = 1 / s.ground.i.J, by_J = (-1.0 / 3) * q * inverse_J;
    d.ground.J += tension * by_J;
    d.I4_J += ((-1.0 / 3) * tension * inverse_J + stiffness * by_J) * by_4;
    d.ground.J_J += ((-4.0 / 3) * tension * inverse_J + stiffness * by_J) * by_J;
  }

  /// y = (I1 I4 − I5)/(2 J √I4)
  static Lanes cosh_B2(const State& s) {
    return (s.ground.i.I1 * s.I4 - s.I5) * (0.5 / (s.ground.i.J * s.stretch));
  }

  /// Of G1 (I5/I4² − 1) + G2 acosh²(y).
  void add_shear(const State& s, FibreSlopes& d) const {
    const double G1 = s.ground.share * fibres.shear_along,
                 G2 = s.ground.share * fibres.shear_across;
    const Lanes inverse_I4 = 1 / s.I4, inverse_J = 1 / s.ground.i.J;
    const Lanes along = G1 * inverse_I4 * inverse_I4;
    d.I4 -= 2 * along * s.I5 * inverse_I4;
    d.I5 += along;
    d.I4_I4 += 6 * along * s.I5 * inverse_I4 * inverse_I4;
    d.I4_I5 -= 2 * along * inverse_I4;

    const Lanes scale = 0.5 * inverse_J / s.stretch, y = cosh_B2(s);
    const Lanes y_1 = s.I4 * scale, y_4 = s.ground.i.I1 * scale - 0.5 * y * inverse_I4,
                y_5 = -scale, y_J = -y * inverse_J;
    const ValueSlopeCurvature B2_squared = squared_acosh(y);
    const Lanes slope = G2 * B2_squared.slope, curvature = G2 * B2_squared.curvature;
    d.ground.I1 += slope * y_1;
    d.I4 += slope * y_4;
    d.I5 += slope * y_5;
    d.ground.J += slope * y_J;
    const Lanes by_J = curvature * y_J - slope * inverse_J;
    d.ground.I1_I1 += curvature * y_1 * y_1;
    d.I1_I4 += 0.5 * slope * scale + curvature * y_1 * y_4;
    d.I1_I5 += curvature * y_1 * y_5;
    d.ground.I1_J += by_J * y_1;
    d.I4_I4 += slope * (0.75 * y * inverse_I4 - s.ground.i.I1 * scale) * inverse_I4 +
               curvature * y_4 * y_4;
    d.I4_I5 += 0.5 * slope * scale * inverse_I4 + curvature * y_4 * y_5;
    d.I4_J += by_J * y_4;
    d.I5_I5 += curvature * y_5 * y_5;
    d.I5_J += by_J * y_5;
    d.ground.J_J += (curvature * y_J - 2 * slope * inverse_J) * y_J;
  }

  /// F in axes of the fibre: e across it at rest, n = F a/λ along it now, F e_i = γ_i λ n + f_i
  /// with f_i across n. Where F e_i − γ_i F a = f_i: ε_i = e_i − γ_i a.
  struct AcrossFibre {
    Vector epsilon[2], n, f[2];
    Lanes gamma[2];
  };
  static AcrossFibre across_fibre(const State& s) {
    AcrossFibre across;
    // Axes across a unit vector, without a branch [Duff 2017, J. Comput. Graph. Tech. 6(1)].
    const Vector& a = s.a;
    const Lanes sign = a[2] < 0 ? all(-1) : all(1), k = -1 / (sign + a[2]), m = a[0] * a[1] * k;
    const Vector e[2] = {{1 + sign * a[0] * a[0] * k, sign * m, -sign * a[0]},
                         {m, sign + a[1] * a[1] * k, -a[1]}};
    across.n = (1 / s.stretch) * s.b;
    for (int i = 0; i < 2; ++i) {
      const Vector Fe = s.ground.F * e[i];
      across.gamma[i] = dot(s.b, Fe) / s.I4;
      across.f[i] = Fe - across.gamma[i] * s.b;
      across.epsilon[i] = e[i] - across.gamma[i] * a;
    }
    return across;
  }

  /// The upper blocks of weight (g : δF)².
  static void add_square(Lanes weight, const Matrix& g, Tangent81& C) {
    for (int l = 0; l < 3; ++l) {
      const Vector weighted = weight * g[l];
      for (int j = l; j < 3; ++j) C.block[j + 3 * l] = C.block[j + 3 * l] + outer(g[j], weighted);
    }
  }
  /// The upper blocks of weight |δF p|².
  static void add_square(Lanes weight, const Vector& p, Tangent81& C) {
    for (int l = 0; l < 3; ++l) {
      for (int j = l; j < 3; ++j) {
        const Lanes on_diagonal = weight * p[j] * p[l];
        for (int k = 0; k < 3; ++k) C.block[j + 3 * l][k][k] += on_diagonal;
      }
    }
  }

  /// The upper blocks of squares that are nowhere less than the second derivative of
  /// G1 B1² + G2 B2², and equal to it without shear.
  /// @return the part of (δF a)² across the fibre, for the caller to add
  Lanes add_projected_shear(const State& s, Tangent81& C) const {
    if (s.ground.share == 0) return Lanes{};
    const AcrossFibre across = across_fibre(s);
    add_projected_shear_along(s, across, all(s.ground.share * fibres.shear_along), C);
    return add_projected_shear_across(s, across, all(s.ground.share * fibres.shear_across), C);
  }

  /// B1² = |γ|². With u = δF a and v_i = δF ε_i its second derivative is
  ///   2 |δγ|² + 4 γ·(u·v/λ² − 2 (n·u/λ) δγ)
  ///     = 2 |δγ − 2 γ n·u/λ|² − 8 |γ|² (n·u/λ)² + |γ| (|u + v'|² − |u − v'|²)/λ²,  v' = γ·v/|γ|,
  /// of which what is negative is left out.
  static void add_projected_shear_along(const State& s, const AcrossFibre& across, Lanes G1,
                                        Tangent81& C) {
    const Lanes inverse_I4 = 1 / s.I4;
    Lanes squared_shear{};
    Vector shear{};
    for (int i = 0; i < 2; ++i) {
      const Vector moved = across.f[i] - (2 * across.gamma[i]) * s.b;
      add_square(2 * G1 * inverse_I4 * inverse_I4,
                 outer(s.b, across.epsilon[i]) + outer(moved, s.a), C);
      squared_shear += across.gamma[i] * across.gamma[i];
      shear = shear + across.gamma[i] * across.epsilon[i];
    }
    const Lanes size = sqrt(squared_shear), inverse_size = size > 0 ? 1 / size : Lanes{};
    add_square(G1 * size * inverse_I4, s.a + inverse_size * shear, C);
  }

  /// B2² = acosh²(y), and of the area d = |f1 x f2| y is 1 + |q|²/(2d) with q = f1 + n x f2. With u
  /// and v_i as above and φ = u/λ, which turns n, the second derivative of y is
  ///   |δq − q δd/d|²/d − |q|² (v1 x v2)·n/d²                           within the plane across n
  ///     + φ·(y 1 − Σ f_i f_iᵀ/d) φ − (2/d) Σ (n·v_i) φ·k_i,  k = f + y (n x f2, −n x f1).
  /// −4 (v1 x v2)·n is |δq|² less a square, the eigenvalues of y 1 − Σ f fᵀ/d are ±sinh B2, and the
  /// last terms are squares, (κ n·v_i − φ·k_i)²/(κ d), less others, for any κ. acosh²'' < 0.
  static Lanes add_projected_shear_across(const State& s, const AcrossFibre& across, Lanes G2,
                                          Tangent81& C) {
    const Vector &n = across.n, f1 = across.f[0], f2 = across.f[1];
    const Lanes y = cosh_B2(s), above_1 = max(Lanes{}, y - 1);
    const Lanes slope = G2 * squared_acosh(y).slope, inverse_d = s.stretch / s.ground.i.J;
    const Matrix of_d = (1 / s.ground.i.J) * s.ground.cof - outer((1 / s.I4) * s.b, s.a);  // δd/d
    const Vector t1 = (1 / sqrt(dot(f1, f1))) * f1, t2 = cross(n, t1);
    const Matrix of_q[2] = {outer(t1, across.epsilon[0]) - outer(t2, across.epsilon[1]),
                            outer(t2, across.epsilon[0]) + outer(t1, across.epsilon[1])};
    const Lanes q[2] = {dot(t1, f1) - dot(t2, f2), dot(t2, f1) + dot(t1, f2)};
    for (int i = 0; i < 2; ++i) {
      add_square(slope * inverse_d, of_q[i] - q[i] * of_d, C);
      add_square(0.5 * slope * above_1 * inverse_d, of_q[i], C);
    }
    const Vector k[2] = {f1 + y * cross(n, f2), f2 - y * cross(n, f1)};
    const Lanes size = sqrt((dot(k[0], k[0]) + dot(k[1], k[1])) * inverse_d);
    const Lanes scale = size > 0 ? 1 / (size * s.stretch) : Lanes{};
    for (int i = 0; i < 2; ++i)
      add_square(0.5 * slope * size * inverse_d,
                 outer(n, across.epsilon[i]) - outer(scale * k[i], s.a), C);
    return slope * sqrt(above_1 * (y + 1)) / s.I4;
  }

  /// ∂I5/∂F
  static Matrix fifth_invariant_gradient(const State& s) {
    return outer(s.b, all(2) * s.w) + outer(s.ground.F * s.w, all(2) * s.a);
  }
};

}  // namespace
}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
