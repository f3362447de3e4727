#pragma once

#include "tools/anatomy/anatomy_knee_tissue.hpp"

/// The groove of the femur in which the patella slides, of a right knee in extension. mm.
///
/// It goes on from both condyles in front (phi from kTrochleaTopDeg to kTrochleaEndDeg): around an
/// axis through their centres its radius at x is theirs near the two ridges, and less in the valley
/// between them. The lateral ridge rises towards the top:
///
///     ridge  ___                      ___  ridge
///    lateral    `-.                .-'     medial
///                  `-._        _.-'
///                      `--..--'
namespace articular::anatomy {

constexpr double kTrochleaTopDeg = -100, kTrochleaEndDeg = -42.5;

/// Radius of the articular surface at x, where phi is the direction of the normal as of a condyle.
double trochlea_radius(double x, double phi);

/// A point `depth` below the articular surface.
Vec3 trochlea_point(double x, double phi, double depth);

/// Where a point is beside the trochlea.
struct TrochleaPlace {
  double distance;  // to the articular surface, about, > 0 outside
  double u, v;      // |u|, |v| <= 1 on the cartilage; u across, v from the top down
};
TrochleaPlace trochlea_place(const Vec3& p);

/// @param mean  thickness, volume by articular area
/// Nodes come in layers, as in femoral_cartilage().
Mesh trochlear_cartilage(double mean, const KneeResolution& resolution);
/// Thickness in the middle of that layer.
double trochlear_full_thickness(double mean);

}  // namespace articular::anatomy
