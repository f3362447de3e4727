#include "tools/verify/laws.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fem/sparse/block_matrix.hpp"
#include "tools/verify/meshes.hpp"
#include "tools/verify/random.hpp"
#include "tools/verify/scene.hpp"

namespace articular::tools {
namespace {

/// Round-off: sums of some hundred elements, and pressures of κ = 10 to 100 times the stress.
constexpr double kRoundOff = 1e-9;
/// Of central differences with steps of 3e-5 of an element. Laws that stiffen fast have 2e-8.
constexpr double kDifference = 1e-7;

const Vec3 kSize(0.004, 0.005, 0.006);  // of the block [m]

enum class Measure {
  Difference,  // of the Cauchy stresses along x and z, σx − σz
  Mean,        // of the three Cauchy stresses
  NominalX,    // first Piola stress along x
  NominalZ
};

/// What is measured at three stretches, and its closed form [Pa].
struct Stress {
  const char* words;
  Vec3 stretch;
  Measure measure;
  double expected;
};

struct LawCase {
  const char* name;
  const char* constants;  // of `material`, one a line
  double activation;      // of fibres, which run along x
  bool turns;             // rotations do not strain it: it is measured turned
  std::vector<Stress> stresses;
};

/// Uniaxial stress at constant volume: stretches s, 1/√s, 1/√s.
Vec3 uniaxial(double s) { return {s, 1 / std::sqrt(s), 1 / std::sqrt(s)}; }

/// σx − σz = 2 (λ² − 1/λ)(∂Ψ/∂I1 + ∂Ψ/∂I2/λ) of a law of Ī1 and Ī2. [Bonet, Wood 2008, ch. 6;
/// Holzapfel 2000, Nonlinear Solid Mechanics, ch. 6.5]
double of_invariants(double s, double by_I1, double by_I2) {
  return 2 * (s * s - 1 / s) * (by_I1 + by_I2 / s);
}

/// Ī1 − 3 in uniaxial stress.
double stretch_invariant(double s) { return s * s + 2 / s - 3; }

/// E = 20 kPa, ν = 0.4: Lamé's μ = E/2(1 + ν), λ = E ν/((1 + ν)(1 − 2ν)), κ = E/3(1 − 2ν).
constexpr double kMu = 20e3 / 2.8, kLambda = 20e3 * 0.4 / (1.4 * 0.2), kKappa = 20e3 / 0.6;
constexpr const char* kElastic = R"(young_modulus = "20 kPa"
poisson_ratio = 0.4)";

/// Laws in which uniaxial strain diag(1, 1, s) has the stresses Pz = (λ + 2μ)(s − 1), the
/// aggregate modulus, and Px = λ (s − 1) where the law is Hooke's of S − 1, F = R S.
std::vector<LawCase> elastic_laws() {
  constexpr double s = 0.7, aggregate = kLambda + 2 * kMu;
  const Stress along{"Pz, uniaxial strain", Vec3(1, 1, s), Measure::NominalZ, aggregate * (s - 1)};
  const Stress across{"Px, uniaxial strain", Vec3(1, 1, s), Measure::NominalX, kLambda * (s - 1)};
  // [Smith, De Goes, Kim 2018] at J = 1 is μ/2 (I1 − 3).
  const Stress tension{"sx - sz, uniaxial", uniaxial(1.5), Measure::Difference,
                       of_invariants(1.5, kMu / 2, 0)};
  // κ (J − 1) at the stretch 1.1 in all directions.
  const Stress swelling{"mean stress, swollen", Vec3::Constant(1.1), Measure::Mean,
                        kKappa * (std::pow(1.1, 3) - 1)};
  return {{"linear", kElastic, 0, false, {along, across}},
          {"corotated", kElastic, 0, true, {along, across}},
          {"neo-hookean", kElastic, 0, true, {along, tension}},
          {"isochoric-neo-hookean", kElastic, 0, true, {tension, swelling}}};
}

/// Coupled laws in uniaxial strain diag(1, 1, s), from their energies [Bonet, Wood 2008, ch. 6;
/// Holmes, Mow 1990, J Biomech 23:1145]; of Holmes and Mow Q = β (s² − 1 − 2 ln s) there.
std::vector<LawCase> coupled_laws() {
  constexpr double s = 0.8, green = (s * s - 1) / 2;
  const Vec3 pressed(1, 1, s);
  const double log_law = kMu * (s - 1 / s) + kLambda * std::log(s) / s;
  constexpr double mu = 20e3 / 2.4, lambda = 20e3 * 0.2 / (1.2 * 0.6), beta = 1.5;  // ν = 0.2
  const double exponential = std::exp(beta * (s * s - 1 - 2 * std::log(s)));
  const double cartilage = (lambda + 2 * mu) / 2 * (s - 1 / s) * exponential;
  const auto along = [&](double expected) {
    return Stress{"Pz, uniaxial strain", pressed, Measure::NominalZ, expected};
  };
  const auto across = [&](double expected) {
    return Stress{"Px, uniaxial strain", pressed, Measure::NominalX, expected};
  };
  return {
      {"st-venant-kirchhoff",
       kElastic,
       0,
       true,
       {across(kLambda * green), along((kLambda + 2 * kMu) * green * s)}},
      {"coupled-neo-hookean", kElastic, 0, true, {across(kLambda * std::log(s)), along(log_law)}},
      {"holmes-mow",
       R"(young_modulus = "20 kPa"
poisson_ratio = 0.2
beta = 1.5)",
       0,
       true,
       {along(cartilage)}}};
}

std::vector<LawCase> isochoric_laws() {
  constexpr double s = 1.3, swell = 1.1, kappa = 1e5;
  const Vec3 swollen = Vec3::Constant(swell);
  const double J = std::pow(swell, 3);
  const double I1 = stretch_invariant(s);
  return {{"mooney-rivlin",
           R"(c10 = "3 kPa"
c01 = "1 kPa"
bulk_modulus = "100 kPa"
volumetric = "quadratic")",
           0,
           true,
           {{"sx - sz, uniaxial", uniaxial(s), Measure::Difference, of_invariants(s, 3e3, 1e3)},
            {"mean stress, swollen", swollen, Measure::Mean, kappa * (J - 1)}}},
          {"yeoh",
           R"(c10 = "1037 Pa"
c20 = "486 Pa"
bulk_modulus = "100 kPa"
volumetric = "logarithmic")",
           0,
           true,
           {{"sx - sz, uniaxial", uniaxial(s), Measure::Difference,
             of_invariants(s, 1037 + 2 * 486 * I1, 0)},
            {"mean stress, swollen", swollen, Measure::Mean, kappa * std::log(J) / J}}},
          {"ogden",  // σx − σz = Σ c/m (λx^m − λz^m) [Ogden 1972]
           R"(terms = [{ c = "10 kPa", m = 2.5 }, { c = "2 kPa", m = -3 }]
bulk_modulus = "100 kPa"
volumetric = "quadratic")",
           0,
           true,
           {{"sx - sz, uniaxial", uniaxial(s), Measure::Difference,
             4e3 * (std::pow(s, 2.5) - std::pow(s, -1.25)) -
                 2e3 / 3 * (std::pow(s, -3) - std::pow(s, 1.5))},
            {"mean stress, swollen", swollen, Measure::Mean, kappa * (J - 1)}}},
          {"veronda-westmann",
           R"(c1 = "10 kPa"
c2 = 2
bulk_modulus = "100 kPa"
volumetric = "quadratic")",
           0,
           true,
           {{"sx - sz, uniaxial", uniaxial(s), Measure::Difference,
             of_invariants(s, 1e4 * 2 * std::exp(2 * I1), -1e4)},
            {"mean stress, swollen", swollen, Measure::Mean, kappa * (J - 1)}}}};
}

/// Tension along the fibres adds λ dW/dλ to the ground substance: [Weiss 1996, eq. 7.2] and
/// [Blemker 2005], see fem/THEORY.md.
std::vector<LawCase> fibred_laws() {
  constexpr double toe = 1.03, taut = 1.1, toe_end = 1.046;  // [-] stretches
  constexpr double c3 = 13.9e3, c4 = 116.22, c5 = 535e6, ground = 1.95e6;
  const auto ligament_fibre = [=](double s) {
    const double end = std::min(s, toe_end);
    return c3 * (std::exp(c4 * (end - 1)) - 1) + c5 * std::max(s - toe_end, 0.0);
  };
  constexpr double optimal = 1.05, max_stress = 0.3e6, active = 0.7;
  const auto muscle_fibre = [=](double s) {
    const double n = s / optimal;
    const double passive = n > 1 ? 0.05 * (std::exp(6.6 * (n - 1)) - 1) : 0;
    return max_stress * n * (passive + active * (1 - 4 * (1 - n) * (1 - n)));
  };
  return {{"transversely-isotropic",
           R"(c10 = "1.95 MPa"
c3 = "13.9 kPa"
c4 = 116.22
c5 = "535 MPa"
toe_end = 1.046
bulk_modulus = "100 MPa"
fibres = { direction = [1, 0, 0] })",
           0,
           true,
           {{"sx - sz, slack fibres", uniaxial(0.9), Measure::Difference,
             of_invariants(0.9, ground, 0)},
            {"sx - sz, toe region", uniaxial(toe), Measure::Difference,
             of_invariants(toe, ground, 0) + ligament_fibre(toe)},
            {"sx - sz, taut fibres", uniaxial(taut), Measure::Difference,
             of_invariants(taut, ground, 0) + ligament_fibre(taut)}}},
          {"muscle",
           R"(c10 = "1 kPa"
optimal_stretch = 1.05
bulk_modulus = "1 MPa"
fibres = { direction = [1, 0, 0] })",
           active,
           true,
           {{"sx - sz, short, active", uniaxial(0.9), Measure::Difference,
             of_invariants(0.9, 1e3, 0) + muscle_fibre(0.9)},
            {"sx - sz, long, active", uniaxial(1.2), Measure::Difference,
             of_invariants(1.2, 1e3, 0) + muscle_fibre(1.2)}}}};
}

/// A block of one law and kind of element.
class Block {
 public:
  Block(const Laboratory& laboratory, const LawCase& law, const char* element)
      : activation_(law.activation),
        model_(model_of(laboratory, scene(laboratory, law, element))),
        elements_(model_.tissues[0].elements) {}

  const Positions& start() const { return model_.tissues[0].X; }
  double energy(const Positions& x) const { return elements_.energy(x, activation_); }
  Eigen::VectorXd pressure(const Positions& x) const {
    Eigen::VectorXd p;
    elements_.pressure(x, p);
    return p;
  }
  Positions force(const Positions& x, const Eigen::VectorXd& p) const {
    Positions f = Positions::Zero(3, x.cols());
    elements_.add_internal_force(x, p, activation_, f);
    return f;
  }
  Positions force(const Positions& x) const { return force(x, pressure(x)); }
  /// K w
  Eigen::VectorXd stiffness_times(const Positions& x, const Eigen::VectorXd& w) const {
    fem::BlockMatrix K = elements_.make_matrix();
    K.set_zero();
    elements_.add_stiffness(x, pressure(x), activation_, fem::Tangent::Consistent, 1, K);
    Eigen::VectorXd y(w.size());
    K.multiply(w, y);
    return y;
  }

 private:
  static Scene scene(const Laboratory& laboratory, const LawCase& law, const char* element) {
    sim::write_mesh(laboratory.folder / "block.vtu", irregular_box(kSize, {3, 3, 3}), 1);
    return {"block", fmt::format(R"(
duration = "1 s"
contact = false
[[body]]
name = "block"
kind = "tissue"
mesh = {{ file = "block.vtu", unit = "m" }}
density = "1000 kg/m^3"
[body.material]
law = "{}"
element = "{}"
{}
)",
                                 law.name, element, law.constants)};
  }

  double activation_;
  sim::Model model_;
  const sim::TissueElements& elements_;
};

/// The nominal stresses along the three axes, from the forces on the faces at the ends of each.
Vec3 nominal_stresses(const Positions& X, const Positions& f) {
  Vec3 stress = Vec3::Zero();
  for (Eigen::Index i = 0; i < X.cols(); ++i)
    for (int k = 0; k < 3; ++k)
      if (X(k, i) > (1 - 1e-9) * kSize[k]) stress[k] += f(k, i) * kSize[k] / kSize.prod();
  return stress;
}

/// The largest force on a node inside, where uniform stress leaves none.
double force_inside(const Positions& X, const Positions& f) {
  double most = 0;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const Vec3 from_ends = X.col(i).cwiseMin(kSize - X.col(i));
    if ((from_ends.array() > 1e-3 * kSize.array()).all()) most = std::max(most, f.col(i).norm());
  }
  return most;
}

double measured(const Stress& stress, const Vec3& nominal) {
  const Vec3 cauchy = nominal.cwiseProduct(stress.stretch) / stress.stretch.prod();
  switch (stress.measure) {
    case Measure::Difference:
      return cauchy.x() - cauchy.z();
    case Measure::Mean:
      return cauchy.mean();
    case Measure::NominalX:
      return nominal.x();
    case Measure::NominalZ:
      return nominal.z();
  }
  return 0;
}

Mat3 turn(const LawCase& law) {
  if (!law.turns) return Mat3::Identity();
  return Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
}

/// Everything about one block, and what is wrong with the derivatives where it is bent.
void solve(const LawCase& law, const Block& block, const std::string& element,
           std::vector<Finding>& findings) {
  const Mat3 R = turn(law);
  double inside = 0;  // relative to the sum of all forces
  for (const Stress& stress : law.stresses) {
    const Positions x = R * stress.stretch.asDiagonal() * block.start();
    const Positions f = R.transpose() * block.force(x);
    findings.push_back(relative(fmt::format("{}, {}", stress.words, element), "Pa", stress.expected,
                                measured(stress, nominal_stresses(block.start(), f)), kRoundOff));
    inside = std::max(inside, force_inside(block.start(), f) / f.colwise().norm().sum());
  }
  findings.push_back(vanishing("force inside, " + element, "of all forces", inside, 1, kRoundOff));

  Random number;
  const Positions random =
      Positions::NullaryExpr(3, block.start().cols(), [&] { return number(); });
  const double size = kSize.minCoeff();
  const Positions x =
      R * (law.stresses.back().stretch.asDiagonal() * block.start()) + 0.01 * size * random;
  const Positions w = random.rowwise().reverse();  // another random direction
  const double h = 1e-5 * size;                    // [m]
  const Positions f = block.force(x);
  const double power = (f.array() * w.array()).sum();
  const double by_energy = (block.energy(x + h * w) - block.energy(x - h * w)) / (2 * h);
  // By the sizes of both: in a random direction most of the power cancels.
  findings.push_back(vanishing("force against energy, " + element, "relative",
                               (by_energy - power) / (f.norm() * w.norm()), 1, kDifference));
  const Eigen::VectorXd p = block.pressure(x);
  const Eigen::VectorXd by_force =
      ((block.force(x + h * w, p) - block.force(x - h * w, p)) / (2 * h)).reshaped();
  const Eigen::VectorXd by_stiffness = block.stiffness_times(x, w.reshaped());
  findings.push_back(vanishing("tangent against force, " + element, "relative",
                               (by_stiffness - by_force).norm() / by_force.norm(), 1, kDifference));
}

}  // namespace

std::vector<Problem> law_problems() {
  std::vector<Problem> problems;
  for (const auto& laws : {elastic_laws(), coupled_laws(), isochoric_laws(), fibred_laws()})
    for (const LawCase& law : laws)
      problems.push_back(
          {std::string("law/") + law.name, true, [law](const Laboratory& laboratory) {
             std::vector<Finding> findings;
             for (const char* element : {"plain", "smoothed"})
               solve(law, Block(laboratory, law, element), element, findings);
             return findings;
           }});
  return problems;
}

}  // namespace articular::tools
