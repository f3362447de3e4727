#pragma once

namespace articular::fem {

/// How much of its largest stress activated muscle has at the length of its sarcomeres
/// [Guccione 1993]: at a stretch λ the sarcomere is l = l_R λ long, and
///
///   f = Ca0²/(Ca0² + ECa50²),   ECa50 = Ca0max/√(exp(B (l − l0)) − 1),
///
/// which is (1 − exp(−x))/(1 + (r − 1) exp(−x)) with x = B (l − l0) and r = (Ca0max/Ca0)²: 0 up to
/// l0, then rising towards 1. There is no descending limb. The slope jumps at l0.
///
/// [Guccione 1993] Guccione, Waldman, McCulloch. Mechanics of active contraction in cardiac muscle:
///                 Part II. J. Biomech. Eng. 115.
class ForceLength {
 public:
  /// Defaults are the published ones of cardiac muscle.
  struct Constants {
    double sarcomere_length = 1.85e-6;  // l_R, at rest [m], > 0
    double zero_length = 1.58e-6;       // l0, of no active stress [m], > 0
    double b = 4.75e6;                  // B [1/m], > 0
    double calcium = 4.35;              // Ca0 inside the cell [µmol/l], > 0, at most:
    double max_calcium = 4.35;          // Ca0max [µmol/l]
  };
  /// @throws std::invalid_argument naming a constant that is out of range
  explicit ForceLength(const Constants& c);

  double factor(double stretch) const;  // f
  double slope(double stretch) const;   // df/dλ
  /// ∫ f dλ/λ up to the stretch, the work of the fibre per largest stress: to round-off, so that
  /// energy and stress belong together. It has no closed form.
  double work(double stretch) const;

 private:
  double exponent(double stretch) const;  // x

  double rate_;          // B l_R [-]
  double zero_stretch_;  // l0/l_R [-]
  double ratio_;         // r [-], at least 1
};

}  // namespace articular::fem
