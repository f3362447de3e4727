#pragma once

#include "tools/anatomy/anatomy_mesh.hpp"

/// The articular surfaces of a right knee in extension. mm; x to the subject's left (medial), y
/// posterior, z up; the lowest points of both condyles lie at y = 0, z = 0.
///
/// Sagittal plane of a condyle (anterior to the left); phi is the direction of the normal, 0 down:
///
///                 .-'''-.            two arcs with a common tangent at `transition`:
///               .'   + C2'.          distal radius around C1 = (0, distal_radius),
///              /  C1 +     |         posterior radius around C2
///              |           /
///               '._   _ _.'
///        phi < 0   '''     phi = transition
///
/// In the frontal plane the profile is rounded with `coronal_radius`: each arc is a piece of a
/// torus, so that distances to it are exact.
namespace articular::anatomy {

/// Medial or lateral half of the joint. Sources: scenarios/SOURCES.md.
struct Compartment {
  double side;  // 1 medial, -1 lateral: the sign of x
  // Condyle, with its cartilage.
  double distal_radius, posterior_radius, transition;  // [mm], [mm], [rad]
  double coronal_radius, coronal_angle;                // [mm]; cartilage lies within ± [rad]
  double femoral_thickness;                            // mean of the cartilage
  // Plateau: half axes of its outline, sagittal curvature (> 0 concave), the radius with which it
  // rises to the eminence.
  double half_width, half_depth, sagittal_curvature, eminence_radius;
  double tibial_thickness;
  // Meniscus: half axes of the outer rim, angle from its middle to the ends of the horns, angles in
  // front and behind from which on they go straight towards their roots; width and height of the
  // rim in front, in the middle and behind.
  double rim_width, rim_depth, horn_angle, straight_front, straight_back;
  double front_width, middle_width, back_width, front_height, middle_height, back_height;
};

const Compartment& medial_compartment();
const Compartment& lateral_compartment();

constexpr double kCompartmentX = 23;    // middles of condyles and plateaus, from the midline
constexpr double kJointGap = 0.1;       // between the cartilages at the start
constexpr double kPlateauSlopeDeg = 3;  // plateaus, posteriorly down

/// Cartilage of a condyle reaches from kFrontDeg to kBackDeg (of phi), and a strip behind it to
/// kBackEndDeg: what touches beyond 60 degrees of flexion.
constexpr double kFrontDeg = -42, kBackDeg = 100, kBackEndDeg = 125;

/// Arc length along the sagittal profile from phi = 0, and back.
double profile_length(const Compartment& c, double phi);
double profile_angle(const Compartment& c, double length);

/// A point `depth` below the articular surface of a condyle.
/// @param alpha  angle in the frontal plane, > 0 to the left
Vec3 condyle_point(const Compartment& c, double phi, double alpha, double depth);

/// Where a point is beside a condyle.
struct CondylePlace {
  double distance;  // to the articular surface, > 0 outside [mm]
  double phi, alpha;
};
CondylePlace condyle_place(const Compartment& c, const Vec3& p);

/// Height of the condyle's lower surface, moved out by `clearance`; kNoSurface where there is none.
double condyle_height(const Compartment& c, double x, double y, double clearance);
constexpr double kNoSurface = 1e3;

/// Height of the plateau's articular surface, continued beyond its outline.
double plateau_height(const Compartment& c, double x, double y);
Vec3 plateau_normal(const Compartment& c, double x, double y);

/// From the square [-1, 1]² to the outline of a plateau, and back.
Eigen::Vector2d plateau_point(const Compartment& c, double u, double v);
Eigen::Vector2d plateau_place(const Compartment& c, double x, double y);

/// Cartilage gets thinner near its rim: this part of its full thickness. u, v in [-1, 1].
double rim_taper(double u, double v);

}  // namespace articular::anatomy
