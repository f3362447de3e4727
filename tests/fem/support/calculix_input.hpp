#pragma once

#include <ostream>

#include "fem/base/types.hpp"

namespace articular::fem {

/// Parts of an input file of CalculiX, which counts from 1: all nodes are the set ALL, all elements
/// (C3D4, the plain linear tetrahedron) the set BLOCK. Numbers are read back as the same bits.
inline void write_calculix_mesh(std::ostream& out, const Positions& X, const Tetrahedra& tets) {
  out.precision(17);
  out << "*NODE, NSET=ALL\n";
  for (Eigen::Index i = 0; i < X.cols(); ++i)
    out << i + 1 << ", " << X(0, i) << ", " << X(1, i) << ", " << X(2, i) << '\n';
  out << "*ELEMENT, TYPE=C3D4, ELSET=BLOCK\n";
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    out << e + 1;
    for (int a = 0; a < 4; ++a) out << ", " << tets(a, e) + 1;
    out << '\n';
  }
}

/// MooneyRivlin<VolumeChange>(mu / 2, 0, kappa), the same law to the last digit, for all elements.
inline void write_calculix_neo_hooke(std::ostream& out, double mu, double kappa) {
  out.precision(17);
  out << "*MATERIAL, NAME=TISSUE\n*HYPERELASTIC, NEO HOOKE\n"
      << mu / 2 << ", " << 2 / kappa << "\n*SOLID SECTION, ELSET=BLOCK, MATERIAL=TISSUE\n";
}

}  // namespace articular::fem
