#include "tools/anatomy/anatomy_mandible.hpp"

#include "tools/anatomy/anatomy_bones.hpp"
#include "tools/anatomy/anatomy_muscles.hpp"

namespace articular::anatomy {
namespace {

constexpr double kMandibleGrid = 1.2;  // contouring grids of the bones that are looked at
constexpr double kSkullGrid = 1.7;
constexpr double kSheetEdge = 0.9;       // contact surfaces of the joint
constexpr double kTeethEdge = 2.5;       // occlusal strips
constexpr double kMuscleBoneGrid = 2.2;  // parts of the bones that muscles touch
constexpr double kRamusGrid = 1.5;       // of the ramus: a coarser one cuts off its tip

/// Left attachments, on the surfaces of mandible_surface and skull_surface. Directions follow the
/// lines of action of MPE18 where it has them (superficial masseter, anterior temporalis, medial
/// and inferior lateral pterygoid); forces and ratios: PECK; sarcomeres of the mean region of the
/// superficial and the deep masseter, of the pterygoids as measured, and of the temporalis as of
/// the whole masseter (scenarios/SOURCES.md).
std::vector<MuscleRow> left_muscles() {
  const std::string skull = "skull", mandible = "mandible", hyoid = "hyoid";
  return {
      {"at",
       "anterior temporalis",
       skull,
       {57, -4, 142},
       mandible,
       {45.5, -0.5, 72},
       158.0,
       2.41,
       1.2698,
       0.5},
      {"mt",
       "middle temporalis",
       skull,
       {66, 33, 146},
       mandible,
       {47, 0, 79},
       95.6,
       2.41,
       1.4186,
       0.48},
      {"pt",
       "posterior temporalis",
       skull,
       {67, 52, 114},
       mandible,
       {47, 0.5, 79},
       75.6,
       2.41,
       1.3109,
       0.51},
      {"sm",
       "superficial masseter",
       skull,
       {57, -3, 73},
       mandible,
       {48.5, 19, 29},
       190.4,
       2.48,
       1.2997,
       0.46},
      {"dm",
       "deep masseter",
       skull,
       {63, 9, 79},
       mandible,
       {48.5, 17, 53},
       81.6,
       2.33,
       1.5428,
       0.29},
      {"mp",
       "medial pterygoid",
       skull,
       {23, 6, 68},
       mandible,
       {44, 22, 32},
       174.8,
       2.52,
       1.2498,
       0.64},
      {"sp",
       "superior lateral pterygoid",
       skull,
       {34, 13, 84},
       mandible,
       {47.5, 28, 77.5},
       28.7,
       2.72,
       1.3610,
       0.0},
      {"ip",
       "inferior lateral pterygoid",
       skull,
       {28, 4, 70},
       mandible,
       {48, 28, 75.5},
       66.9,
       2.83,
       1.3175,
       0.0},
      {"ad",
       "anterior digastric",
       mandible,
       {6, -37, 9},
       hyoid,
       {11, 10, -7},
       40.0,
       0,
       1.2849,
       0.0},
      {"pd", "posterior digastric", skull, {51, 53, 70}, hyoid, {11, 10, -7}, 40.0, 0, 1.2849, 0.0},
      {"am",
       "anterior mylohyoid",
       mandible,
       {16, -24, 19},
       hyoid,
       {2, 4, -8},
       35.4,
       0,
       1.2849,
       0.0},
      {"pm",
       "posterior mylohyoid",
       mandible,
       {28, -4, 29},
       hyoid,
       {6, 6, -8},
       35.4,
       0,
       1.2849,
       0.0},
      {"gh", "geniohyoid", mandible, {2, -35, 15}, hyoid, {2, 6, -6}, 32.0, 0, 1.2849, 0.0},
      {"sh", "stylohyoid", skull, {38, 44, 68}, hyoid, {11, 10, -6}, 15.6, 0, 1.2849, 0.0},
  };
}

void add_both_sides(const std::string& name, const std::string& ending, const Mesh& left,
                    Anatomy& anatomy) {
  anatomy.meshes[name + "_left" + ending] = left;
  anatomy.meshes[name + "_right" + ending] = mirrored(left);
}

}  // namespace

std::vector<MuscleRow> mandible_muscles() {
  std::vector<MuscleRow> rows;
  for (const MuscleRow& left : left_muscles())
    for (const char side : {'l', 'r'}) {
      MuscleRow row = left;
      row.id = side + left.id;
      if (side == 'r') {
        row.upper.x() *= -1;
        row.lower.x() *= -1;
      }
      rows.push_back(row);
    }
  return rows;
}

Anatomy mandible_anatomy(double disc_edge, double slope_deg, double guidance_deg) {
  const FossaProfile fossa = fossa_profile(slope_deg);
  Anatomy anatomy;
  add_both_sides("disc", ".vtu", disc(disc_edge, fossa), anatomy);
  add_both_sides("condyle", ".vtp", condyle_sheet(kSheetEdge), anatomy);
  add_both_sides("fossa", ".vtp", fossa_sheet(kSheetEdge, fossa), anatomy);
  anatomy.meshes["mandible.vtp"] = mandible_surface(kMandibleGrid);
  anatomy.meshes["hyoid.vtp"] = hyoid_surface(kMandibleGrid);
  anatomy.meshes["skull.vtp"] = skull_surface(kSkullGrid, fossa);
  anatomy.meshes["lower_teeth.vtp"] = lower_teeth_sheet(kTeethEdge);
  anatomy.meshes["upper_teeth.vtp"] = upper_teeth_sheet(kTeethEdge);
  anatomy.meshes["lower_guiding_teeth.vtp"] = lower_guiding_teeth(guidance_deg);
  anatomy.meshes["upper_guiding_teeth.vtp"] = upper_guiding_teeth(guidance_deg);
  anatomy.muscles = mandible_muscles();
  anatomy.landmarks = {
      {"incisor edge", "mandible", kIncisor},
      {"first molar left", "mandible", arch_point(23.5)},
      {"first molar right", "mandible", arch_point(23.5).cwiseProduct(Vec3(-1, 1, 1))},
      {"condyle centre left", "mandible", kCondyle},
      {"condyle centre right", "mandible", kCondyle.cwiseProduct(Vec3(-1, 1, 1))},
      {"gonion left", "mandible", {48.2, 29, 23}},
      {"gonion right", "mandible", {-48.2, 29, 23}},
      {"pogonion", "mandible", {0, -48, 12}},
  };
  return anatomy;
}

void add_muscle_bodies(double element_size, Anatomy& anatomy) {
  for (const FibreBody& shape : muscle_shapes())
    add_both_sides(shape.name, ".vtu", muscle_mesh(shape, element_size), anatomy);
  add_both_sides("ramus", ".vtp", ramus_sheet(kRamusGrid), anatomy);
  add_both_sides("temporal", ".vtp", temporal_sheet(kMuscleBoneGrid), anatomy);
  add_both_sides("pterygoid", ".vtp", pterygoid_sheet(kMuscleBoneGrid), anatomy);
}

}  // namespace articular::anatomy
