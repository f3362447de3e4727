#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

/// Numbers with units, as scenario files write them: "15 kPa", "1.06 g/cm^3", "0 0 -9.81 m/s^2".
///
/// A unit is a product of factors; a factor is a symbol with an optional integer power:
///
///     m cm mm um µm km   s ms us µs min   kg g mg t   N mN kN   Pa kPa MPa GPa
///     J mJ   W   Hz   rad deg
///
/// Products are written with a space, `*` or `·`, powers as mm^2 or mm², quotients with `/`. After
/// a `/` a product needs parentheses: "N/(m s)". "1/s" and "/s" are the same.
namespace articular::sim {

/// Exponents of kilogram, metre, second and radian. The angle counts: "10 rad/s" is not "10 1/s".
struct Dimension {
  int mass = 0, length = 0, time = 0, angle = 0;
  bool operator==(const Dimension&) const = default;
};

/// What a value of the scenario measures, and the words for a message about it.
struct QuantityKind {
  Dimension dimension;
  std::string_view noun;     // "a stress"
  std::string_view example;  // "15 kPa"
  std::string_view vector_example = "";
};

inline constexpr QuantityKind kTime{{0, 0, 1, 0}, "a time", "0.6 s"};
inline constexpr QuantityKind kLength{{0, 1, 0, 0}, "a length", "5 mm", "0 -9.5 36.1 mm"};
inline constexpr QuantityKind kPerLength{{0, -1, 0, 0}, "one over a length", "4.75 1/um"};
inline constexpr QuantityKind kMass{{1, 0, 0, 0}, "a mass", "0.2 kg"};
inline constexpr QuantityKind kAngle{{0, 0, 0, 1}, "an angle", "30 deg", "0 0 30 deg"};
inline constexpr QuantityKind kRate{{0, 0, -1, 0}, "a rate", "10 1/s"};
inline constexpr QuantityKind kDensity{{1, -3, 0, 0}, "a density", "1.06 g/cm^3"};
inline constexpr QuantityKind kStress{{1, -1, -2, 0}, "a stress", "15 kPa", "0 0 -15 kPa"};
inline constexpr QuantityKind kForce{{1, 1, -2, 0}, "a force", "190 N", "0 0 -1 N"};
inline constexpr QuantityKind kMoment{{1, 2, -2, 0}, "a moment", "5 N m", "0 0 5 N m"};
inline constexpr QuantityKind kStiffness{{1, 0, -2, 0}, "a stiffness", "250 N/mm"};
inline constexpr QuantityKind kDamping{{1, 0, -1, 0}, "a damping", "0.05 N s/mm"};
inline constexpr QuantityKind kContactDamping{{1, -2, -1, 0}, "a damping per area", "1e4 Pa s/m"};
inline constexpr QuantityKind kInertia{
    {1, 2, 0, 0}, "an inertia", "147 kg mm^2", "147 246 297 kg mm^2"};
inline constexpr QuantityKind kVelocity{{0, 1, -1, 0}, "a velocity", "5 mm/s", "0 0 5 mm/s"};
inline constexpr QuantityKind kAngularVelocity{
    {0, 0, -1, 1}, "an angular velocity", "2 rad/s", "0 0 2 rad/s"};
inline constexpr QuantityKind kAcceleration{
    {0, 1, -2, 0}, "an acceleration", "9.81 m/s^2", "0 0 -9.81 m/s^2"};

/// One number and one unit, in SI (m, kg, s, rad). Where the unit is a power of ten of SI, the
/// result is the double nearest to the decimal that is written: "0.1 um" is 1e-7 to the last bit.
/// @throws std::invalid_argument  says what was expected, with an example, and what was found
double parse_quantity(std::string_view text, const QuantityKind& kind);

/// Three numbers and one unit for all of them, in SI.
/// @throws std::invalid_argument  as parse_quantity()
Eigen::Vector3d parse_vector(std::string_view text, const QuantityKind& kind);

/// A unit alone, such as "mm": its size in SI.
/// @throws std::invalid_argument  as parse_quantity()
double parse_unit(std::string_view text, const QuantityKind& kind);

/// A unit of whatever it measures.
struct MeasuredUnit {
  Dimension dimension;
  double size = 1;  // in SI
};

/// A unit alone, such as "mm". @throws std::invalid_argument  says what was found
MeasuredUnit parse_any_unit(std::string_view text);

/// "a length", or in base units "kg m^2 s^-1" where there is no word for it.
std::string noun_of(const Dimension& dimension);

}  // namespace articular::sim
