#include "tests/benchmarks/extremes/scene_text.hpp"

#include <fmt/format.h>

namespace articular::benchmarks {

std::string digits(double value) { return fmt::format("{:.17g}", value); }

std::string digits(const Numbers3& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v[0], v[1], v[2]);
}

std::string general(double duration, double step, const std::string& more,
                    const std::string& integrator) {
  return fmt::format(
      "duration = \"{0} s\"\n{2}\n[integrator]\nstep = \"{1} s\"\n{3}\n"
      "[output]\ninterval = \"{0} s\"\nlength_unit = \"m\"\n",
      digits(duration), digits(step), more, integrator);
}

std::string statics(double duration, double step) {
  return general(duration, step, "analysis = \"static\"");
}

std::string box(const std::string& name, const std::string& kind, const Box& shape,
                const std::string& more) {
  return fmt::format(
      "[[body]]\nname = \"{}\"\nkind = \"{}\"\ngeometry = {{ box = {{ size = \"{} m\", cells = "
      "[{}, {}, {}], center = \"{} m\" }} }}\n{}\n",
      name, kind, digits(shape.size), shape.cells[0], shape.cells[1], shape.cells[2],
      digits(shape.center), more);
}

std::string carrier(const std::string& name) {
  return fmt::format("[[body]]\nname = \"{}\"\nkind = \"fixed\"\n", name);
}

std::string ball(const std::string& name, const std::string& kind, double radius,
                 double element_size, const Numbers3& center, const std::string& more) {
  return fmt::format(
      "[[body]]\nname = \"{}\"\nkind = \"{}\"\ngeometry = {{ sphere = {{ radius = \"{} m\", "
      "element_size = \"{} m\", center = \"{} m\" }} }}\n{}\n",
      name, kind, digits(radius), digits(element_size), digits(center), more);
}

std::string density(double value) {
  return fmt::format("density = \"{} kg/m^3\"\n", digits(value));
}

std::string solid(double rho, const std::string& law, double young, double nu,
                  const std::string& more) {
  const char* const element =
      more.find("element") == std::string::npos ? ", element = \"plain\"" : "";
  return density(rho) +
         fmt::format(
             "material = {{ law = \"{}\", young_modulus = \"{} Pa\", poisson_ratio = {}{}{} }}\n",
             law, digits(young), digits(nu), element, more);
}

std::string attach(const std::string& body, const std::string& to, const Numbers3& low,
                   const Numbers3& high) {
  return fmt::format(
      "[[attach]]\nbody = \"{}\"\nto = \"{}\"\nregion = {{ box = [\"{} m\", \"{} m\"] }}\n", body,
      to, digits(low), digits(high));
}

std::string gravity(double acceleration) {
  return fmt::format("[[load]]\nkind = \"gravity\"\nacceleration = \"0 0 {} m/s^2\"\n",
                     digits(-acceleration));
}

std::string motion(const std::string& body, double time, const Numbers3& way,
                   const std::string& interpolation) {
  return fmt::format(
      "[[load]]\nkind = \"motion\"\nbody = \"{}\"\ntime = [\"0 s\", \"{} s\"]\n"
      "translation = [\"0 0 0 m\", \"{} m\"]\ninterpolation = \"{}\"\n",
      body, digits(time), digits(way), interpolation);
}

std::string point_probe(const std::string& name, const std::string& body, const Numbers3& point) {
  return fmt::format(
      "[[probe]]\nname = \"{}\"\nkind = \"point\"\nbody = \"{}\"\npoint = \"{} m\"\n", name, body,
      digits(point));
}

std::string contact_probe(const std::string& name, const std::string& a, const std::string& b) {
  return fmt::format("[[probe]]\nname = \"{}\"\nkind = \"contact\"\nbodies = [\"{}\", \"{}\"]\n",
                     name, a, b);
}

std::string reaction_probe(const std::string& name, const std::string& body) {
  return fmt::format("[[probe]]\nname = \"{}\"\nkind = \"reaction\"\nbody = \"{}\"\n", name, body);
}

std::string energy_probe() { return "[[probe]]\nname = \"energy\"\nkind = \"energy\"\n"; }

}  // namespace articular::benchmarks
