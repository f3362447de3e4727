#pragma once

#include <array>

/// Layers that stiffen as they are pressed flat: cartilage or periodontal ligaments between two
/// surfaces, by the logarithm of what is left of their thickness t [Blankevoort 1991],
///
///   p = −M ln(1 − d/t),   d(p) = t (1 − exp(−p/M)),
///
/// M the constrained modulus. At d = 0 the slope is M/t, that of the linear layer p = M d/t; no
/// pressure makes d = t. From d = 0.9 t on the law goes on by its tangent, of 10 M/t, so that
/// whatever an iteration tries has a finite pressure.
///
/// Layers, and what gives way linearly beside them, carry the same pressure:
///
///   g(p) = c p + Σ d_i(p).
///
/// p(g) is its inverse. g is concave, as no layer gets softer, so Newton's iteration from p = k g,
/// which is no larger than p, rises to it without passing it.
///
/// [Blankevoort 1991] Blankevoort, Kuiper, Huiskes, Grootenboer. Articular contact in a
/// three-dimensional model of the knee. J Biomech 24:1019.
namespace articular::sim {

struct LogarithmicLayer {
  double modulus = 0;    // M [Pa]
  double thickness = 0;  // t [m]; 0: there is none
  /// t/M, at no depth [m/Pa].
  double compliance() const { return thickness > 0 ? thickness / modulus : 0; }
};

struct LayersInSeries {
  double linear = 0;  // c [m/Pa], >= 0
  std::array<LogarithmicLayer, 2> layer;
};

/// At one depth.
struct PressedLayers {
  double energy = 0;    // ∫ p dg from 0 on [J/m²]; apart, g < 0: none
  double pressure = 0;  // [Pa]; apart: k g, negative
  double slope = 0;     // dp/dg [Pa/m]; apart: that at no depth, k
};

/// @param depth  g [m]. Something gives way: c > 0 or a layer is there
PressedLayers pressed(const LayersInSeries& layers, double depth);

}  // namespace articular::sim
