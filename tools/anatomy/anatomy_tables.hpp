#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/anatomy/anatomy_mesh.hpp"

/// An anatomy as the scenarios read it: meshes by file name, muscle attachments and landmarks. mm.
namespace articular::anatomy {

struct MuscleRow {
  std::string id;      // l or r, and two letters
  std::string muscle;  // name
  std::string body_upper;
  Vec3 upper;
  std::string body_lower;
  Vec3 lower;
  double max_force;     // [N], peak, one side
  double sarcomere_um;  // measured with the mouth closed; 0: not known
  double max_over_opt_length;
  double tendon_ratio;
};

/// Length at which a muscle is strongest [mm], from its sarcomeres, or nothing where these are not
/// known. At the length l, with the tendon ratio r, fibres are (l - r l_opt) / ((1 - r) l_opt) =
/// sarcomere / 2.7 um of their optimal length. 2.7 um: optimum of human sarcomeres.
std::optional<double> optimal_length(const MuscleRow& muscle);

struct Landmark {
  std::string name, body;
  Vec3 point;
};

struct Anatomy {
  std::map<std::string, Mesh> meshes;  // by file name: .vtp triangles, .vtu tetrahedra
  std::vector<MuscleRow> muscles;
  std::vector<Landmark> landmarks;
};

/// Everything larger or smaller; angles, forces and ratios stay.
/// @throws std::invalid_argument  for a factor outside [0.75, 1.3]
void scale(Anatomy& anatomy, double factor);

/// The text of muscles.csv and landmarks.csv.
std::string muscles_csv(const std::vector<MuscleRow>& muscles);
std::string landmarks_csv(const std::vector<Landmark>& landmarks);

}  // namespace articular::anatomy
