#include "tools/anatomy/anatomy_knee.hpp"

#include "tools/anatomy/anatomy_knee_bones.hpp"

namespace articular::anatomy {
namespace {

constexpr double kBoneGrid = 1.2;  // contouring grid

}  // namespace

Anatomy knee_anatomy(const KneeResolution& resolution) {
  check_resolution(resolution);
  Anatomy anatomy;
  anatomy.meshes["femur.vtp"] = femur_surface(kBoneGrid);
  anatomy.meshes["tibia.vtp"] = tibia_surface(kBoneGrid);
  for (const Compartment* c : {&medial_compartment(), &lateral_compartment()}) {
    const std::string side = c->side > 0 ? "medial" : "lateral";
    anatomy.meshes["femoral_cartilage_" + side + ".vtu"] = femoral_cartilage(*c, resolution);
    anatomy.meshes["tibial_cartilage_" + side + ".vtu"] = tibial_cartilage(*c, resolution);
    anatomy.meshes["meniscus_" + side + ".vtu"] = meniscus(*c, resolution);
    anatomy.landmarks.push_back({"anterior horn " + side, "meniscus_" + side, horn(*c, -1)});
    anatomy.landmarks.push_back({"posterior horn " + side, "meniscus_" + side, horn(*c, 1)});
    anatomy.landmarks.push_back(
        {"plateau " + side,
         "tibial_cartilage_" + side,
         {c->side * kCompartmentX, 0, plateau_height(*c, c->side * kCompartmentX, 0)}});
  }
  return anatomy;
}

}  // namespace articular::anatomy
