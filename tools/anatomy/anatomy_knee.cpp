#include "tools/anatomy/anatomy_knee.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "tools/anatomy/anatomy_knee_bones.hpp"
#include "tools/anatomy/anatomy_ligaments.hpp"
#include "tools/anatomy/anatomy_meniscus.hpp"
#include "tools/anatomy/anatomy_patella.hpp"
#include "tools/anatomy/anatomy_patellar_tendon.hpp"
#include "tools/anatomy/anatomy_trochlea.hpp"

namespace articular::anatomy {
namespace {

constexpr double kBoneGrid = 1.2;  // contouring grid

/// Mean thickness of cartilage. Sources: scenarios/SOURCES.md.
constexpr double kTrochlearThickness = 2.54, kPatellarThickness = 2.76;

/// Thickness is that of the knee before it is scaled.
Compartment with_cartilage(Compartment c, double factor) {
  c.femoral_thickness *= factor;
  c.tibial_thickness *= factor;
  return c;
}

void add_patella(const KneeResolution& resolution, double factor, const Compartment& medial,
                 const Compartment& lateral, Anatomy& anatomy) {
  const double trochlear = factor * kTrochlearThickness, patellar = factor * kPatellarThickness;
  anatomy.meshes["femur_with_trochlea.vtp"] =
      femur_with_trochlea_surface(kBoneGrid, medial, lateral, trochlear);
  anatomy.meshes["trochlear_cartilage.vtu"] = trochlear_cartilage(trochlear, resolution);
  anatomy.meshes["patella.vtp"] = patella_surface(kBoneGrid, patellar);
  anatomy.meshes["patellar_cartilage.vtu"] = patellar_cartilage(patellar, resolution);
  anatomy.landmarks.push_back({"apex of the patella", "patella", patella_apex()});
  anatomy.landmarks.push_back({"base of the patella", "patella", patella_base()});
}

void add_ligaments(double size, const Compartment& medial, const Compartment& lateral,
                   Anatomy& anatomy) {
  constexpr double kSheetGrid = 1.5;  // a little coarser than what is looked at
  for (const FibreBody& ligament : {medial_collateral(), anterior_cruciate()})
    anatomy.meshes[ligament.name + ".vtu"] = ligament_mesh(ligament, medial, lateral, size);
  anatomy.meshes["femur_medial_side.vtp"] = femoral_side_sheet(kSheetGrid, medial, lateral);
  anatomy.meshes["femur_notch.vtp"] = notch_sheet(kSheetGrid, medial, lateral);
  anatomy.meshes["tibia_eminence.vtp"] = eminence_sheet(kSheetGrid, medial, lateral);
  anatomy.meshes["tibia_medial_side.vtp"] = tibial_side_sheet(kSheetGrid, medial, lateral);
}

}  // namespace

Anatomy knee_anatomy(const KneeResolution& resolution, const KneeShape& shape) {
  check_resolution(resolution);
  if (!(shape.cartilage >= 0.6 && shape.cartilage <= 1.5))
    throw std::invalid_argument(
        fmt::format("--cartilage: {}: expected 0.6 to 1.5", shape.cartilage));
  const double factor = shape.cartilage / shape.scale;
  const Compartment medial = with_cartilage(medial_compartment(), factor),
                    lateral = with_cartilage(lateral_compartment(), factor);
  Anatomy anatomy;
  anatomy.meshes["femur.vtp"] = femur_surface(kBoneGrid, medial, lateral);
  anatomy.meshes["tibia.vtp"] = tibia_surface(kBoneGrid, medial, lateral);
  for (const Compartment* c : {&medial, &lateral}) {
    const std::string side = c->side > 0 ? "medial" : "lateral";
    anatomy.meshes["femoral_cartilage_" + side + ".vtu"] = femoral_cartilage(*c, resolution);
    anatomy.meshes["femoral_cartilage_back_" + side + ".vtu"] =
        femoral_cartilage_back(*c, resolution);
    anatomy.meshes["tibial_cartilage_" + side + ".vtu"] = tibial_cartilage(*c, resolution);
    anatomy.meshes["meniscus_" + side + ".vtu"] = meniscus(*c, resolution);
    anatomy.landmarks.push_back({"anterior horn " + side, "meniscus_" + side, horn(*c, -1)});
    anatomy.landmarks.push_back({"posterior horn " + side, "meniscus_" + side, horn(*c, 1)});
    anatomy.landmarks.push_back(
        {"plateau " + side,
         "tibial_cartilage_" + side,
         {c->side * kCompartmentX, 0, plateau_height(*c, c->side * kCompartmentX, 0)}});
  }
  if (shape.patella) add_patella(resolution, factor, medial, lateral, anatomy);
  if (shape.ligaments) add_ligaments(resolution.size_mm, medial, lateral, anatomy);
  if (shape.patella && shape.ligaments)
    anatomy.meshes["patellar_tendon.vtu"] =
        patellar_tendon_mesh(medial, lateral, factor * kPatellarThickness, resolution.size_mm);
  scale(anatomy, shape.scale);
  return anatomy;
}

}  // namespace articular::anatomy
