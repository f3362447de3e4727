#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"

/// One example of every law of the simulator, for the tests of properties that all have.
namespace articular::fem {

const Vec3 kFibre = Vec3(2, -1, 2) / 3;               // direction of the fibres at rest
const Vec3 kAcross = Vec3(1, 2, 0) / std::sqrt(5.0);  // a direction across them

/// What an example promises.
struct Promise {
  bool objective = true;          // not strained by rotations
  bool shape_only = true;         // the distortion does not feel the volume
  bool inverted = false;          // has numbers for J <= 0
  double least_stretch = 0;       // no number where a principal stretch is this or less
  bool one_shear_modulus = true;  // at rest, in all directions
  Mat3 rest = Mat3::Identity();   // the deformation gradient without stress
};

/// A function of F with its first two derivatives.
struct Jet {
  double value;
  Mat3 gradient;  // ∂/∂F
  Mat9 hessian;   // ∂²/∂vec(F)²
};

/// Ψ, P and ∂P/∂F at F and an activation. Erased types: what tests them compiles once.
using Evaluate = std::function<Jet(const Mat3& F, double activation)>;

/// Of a law whose projected tangent is a sum of those of its parts: ∂P/∂F of the fibres' own part,
/// and what is taken in its place.
struct FibrePart {
  Mat9 hessian, positive;
};

struct LawExample {
  std::string name;
  AnyMaterial material;
  bool fibred;
  Promise promise;
  double scale;  // of its stresses [Pa]
  Evaluate law, distortion;
  std::function<Jet(const Mat3&)> dilatation;
  double bulk_modulus, shear_modulus;                                          // [Pa]
  std::function<FibrePart(const Mat3& F, double activation)> fibre_part = {};  // empty: no parts
};

void PrintTo(const LawExample& example, std::ostream* out);  // found by the test framework

/// Fibred ones have their fibres along kFibre.
std::vector<LawExample> all_laws();

/// Fibres of the anterior cruciate ligament.
ToeLinearFibre cruciate_fibre();

/// Fibres of the heart, and their active stress, which depends on their length.
ToeLinearFibre cardiac_fibre();
ActiveFibre cardiac_activity();

}  // namespace articular::fem
