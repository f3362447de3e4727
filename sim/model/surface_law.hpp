#pragma once

namespace articular::sim {

/// What a contact does beside pressing; nothing by default.
struct SurfaceLaw {
  double friction = 0;       // coefficient [-]
  double slip_velocity = 0;  // v_s [m/s], > 0 with friction
  double damping = 0;        // pressure per closing velocity [Pa s/m]
  bool acts() const { return friction > 0 || damping > 0; }
};

}  // namespace articular::sim
