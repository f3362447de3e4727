#pragma once

#include "fem/material/material.hpp"

/// In-situ strain: what is drawn as at rest is stretched already [Weiss 1995; Maas 2016]. The law
/// is that of the free tissue, and sees what brings it from there to where it is, F_e = F F0. Along
/// fibres with the unit direction a0,
///
///   F0 = s a0 a0ᵀ + s^(−1/2) (1 − a0 a0ᵀ),   det F0 = 1,
///
/// draws fibres out by s and keeps the volume. So a bar that is cut free gets 1/s times as long.
///
/// [Weiss 1995] Weiss, Maker, Schauer. Treatment of initial stress in hyperelastic finite element
///              models of soft tissues. Proc. ASME Summer Bioeng. Conf., BED 29:105.
/// [Maas 2016] Maas, Erdemir, Halloran, Weiss. A general framework for application of prestrain to
///             computational models of biological materials. J. Mech. Behav. Biomed. Mater. 61.
namespace articular::fem {

/// s. @throws std::invalid_argument unless it lies in [0.5, 2]
double checked_prestretch(double s);

/// F0. @param a0  unit vector
Mat3 prestretch_gradient(double s, const Vec3& a0);

/// ∂vec(P)/∂vec(F) from that by F_e: dP = (A : (dF F0)) F0 for a symmetric F0.
Mat9 with_prestretch(const Mat9& A, const Mat3& F0);

template <Hyperelastic Law>
class Prestretched {
 public:
  Prestretched(const Law& law, const Mat3& F0) : law_(law), F0_(F0) {}

  double shear_modulus() const { return law_.shear_modulus(); }  // [Pa], of the free tissue
  double energy_density(const Mat3& F) const { return law_.energy_density(F * F0_); }
  Mat3 first_piola(const Mat3& F) const { return law_.first_piola(F * F0_) * F0_; }
  Mat9 tangent(const Mat3& F) const { return with_prestretch(law_.tangent(F * F0_), F0_); }

 private:
  Law law_;
  Mat3 F0_;
};

}  // namespace articular::fem
