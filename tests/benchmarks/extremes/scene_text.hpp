#pragma once

#include <array>
#include <string>

namespace articular::benchmarks {

/// Parts of scenario files. Lengths in m, SI throughout.
using Numbers3 = std::array<double, 3>;

/// "1 2 3" with all digits.
std::string digits(double value);
std::string digits(const Numbers3& values);

/// @param step  [s]; frames are written at the start and the end
std::string general(double duration, double step, const std::string& more = "",
                    const std::string& integrator = "");
std::string statics(double duration, double step);

struct Box {
  Numbers3 size{0.01, 0.01, 0.01};
  std::array<int, 3> cells{2, 2, 2};
  Numbers3 center{0, 0, 0};
};
/// @param kind  "fixed", "rigid" or "tissue"  @param more  lines of the body's own table
std::string box(const std::string& name, const std::string& kind, const Box& shape,
                const std::string& more = "");
/// A fixed body without a mesh: it only carries what is attached to it.
std::string carrier(const std::string& name);
std::string ball(const std::string& name, const std::string& kind, double radius,
                 double element_size, const Numbers3& center, const std::string& more = "");

/// density = and material =, of a tissue. @param more  keys of the material, after a comma
std::string solid(double density, const std::string& law, double young, double nu,
                  const std::string& more = "");
std::string density(double value);

std::string attach(const std::string& body, const std::string& to, const Numbers3& low,
                   const Numbers3& high);
std::string gravity(double acceleration);  // along -z
/// Moves a fixed body by `way` until `time`, and lets it stay there.
std::string motion(const std::string& body, double time, const Numbers3& way,
                   const std::string& interpolation = "smooth");
std::string point_probe(const std::string& name, const std::string& body, const Numbers3& point);
std::string contact_probe(const std::string& name, const std::string& a, const std::string& b);
std::string reaction_probe(const std::string& name, const std::string& body);
std::string energy_probe();

}  // namespace articular::benchmarks
