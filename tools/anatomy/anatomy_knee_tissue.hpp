#pragma once

#include "tools/anatomy/anatomy_knee_joint.hpp"

/// Cartilage of the knee as tetrahedra. mm.
namespace articular::anatomy {

/// Element size along the surfaces, and layers through the thickness. Cartilage of condyles and
/// plateaus is `focus` times finer where that of a standing knee touches.
/// @throws std::invalid_argument by check_resolution for sizes outside [0.4, 4] mm, layers outside
/// [2, 6], and a focus outside [1, 3]
struct KneeResolution {
  double size_mm = 2.5;
  int layers = 2;
  double focus = 1;
};
void check_resolution(const KneeResolution& resolution);

/// Layer on a condyle or a plateau. Nodes come in layers from bone (first) to the articular surface
/// (last); its mean thickness, volume by articular area, is the compartment's.
Mesh femoral_cartilage(const Compartment& c, const KneeResolution& resolution);
Mesh tibial_cartilage(const Compartment& c, const KneeResolution& resolution);

/// The strip that goes on behind femoral_cartilage(), as thick as that is along its back edge. It
/// has no node in common with it.
Mesh femoral_cartilage_back(const Compartment& c, const KneeResolution& resolution);

/// Fraction of the cartilage's full thickness and place in the layer at a point of a condyle.
struct CartilagePlace {
  double u, v;  // |u|, |v| <= 1 on the cartilage
};
CartilagePlace femoral_place(const Compartment& c, double phi, double alpha);
/// Thickness in the middle of the layers that the meshes have.
double femoral_full_thickness(const Compartment& c);
double tibial_full_thickness(const Compartment& c);

}  // namespace articular::anatomy
