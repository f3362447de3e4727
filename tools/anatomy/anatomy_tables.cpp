#include "tools/anatomy/anatomy_tables.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace articular::anatomy {

void scale(Anatomy& anatomy, double factor) {
  if (!(factor >= 0.75 && factor <= 1.3))
    throw std::invalid_argument(fmt::format("--scale: {}: expected 0.75 to 1.3", factor));
  for (auto& [name, mesh] : anatomy.meshes) mesh.X_mm *= factor;
  for (MuscleRow& muscle : anatomy.muscles) {
    muscle.upper *= factor;
    muscle.lower *= factor;
  }
  for (Landmark& landmark : anatomy.landmarks) landmark.point *= factor;
}

std::optional<double> optimal_length(const MuscleRow& muscle) {
  constexpr double kOptimalSarcomere = 2.7;  // [um]
  if (muscle.sarcomere_um == 0) return std::nullopt;
  const double r = muscle.tendon_ratio;
  return (muscle.upper - muscle.lower).norm() /
         (r + (1 - r) * muscle.sarcomere_um / kOptimalSarcomere);
}

std::string muscles_csv(const std::vector<MuscleRow>& muscles) {
  std::string text =
      "id,muscle,side,body_upper,ux_mm,uy_mm,uz_mm,body_lower,lx_mm,ly_mm,lz_mm,"
      "length_in_this_geometry_mm,max_force_N,sarcomere_um,optimal_length_mm,max_over_opt_length,"
      "tendon_ratio\n";
  for (const MuscleRow& m : muscles) {
    const std::optional<double> optimum = optimal_length(m);
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{:.2f},{},{},{},{},{}\n", m.id, m.muscle,
        m.id[0] == 'l' ? "left" : "right", m.body_upper, m.upper.x(), m.upper.y(), m.upper.z(),
        m.body_lower, m.lower.x(), m.lower.y(), m.lower.z(), (m.upper - m.lower).norm(),
        m.max_force, optimum ? fmt::format("{}", m.sarcomere_um) : "",
        optimum ? fmt::format("{:.2f}", *optimum) : "", m.max_over_opt_length, m.tendon_ratio);
  }
  return text;
}

std::string landmarks_csv(const std::vector<Landmark>& landmarks) {
  std::string text = "landmark,body,x_mm,y_mm,z_mm\n";
  for (const Landmark& l : landmarks)
    text += fmt::format("{},{},{:.3f},{:.3f},{:.3f}\n", l.name, l.body, l.point.x(), l.point.y(),
                        l.point.z());
  return text;
}

}  // namespace articular::anatomy
