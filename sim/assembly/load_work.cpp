#include "sim/assembly/load_work.hpp"

#include <Eigen/Geometry>

#include "sim/assembly/energies.hpp"
#include "sim/loads/gravity.hpp"
#include "sim/loads/surface_load.hpp"
#include "sim/model/model.hpp"
#include "sim/scenario/curve.hpp"

namespace articular::sim {

double load_work(const Model& model, const Configuration& from, const Configuration& to,
                 double t_from, double t_to) {
  const auto mean = [&](const Curve& profile) {
    return 0.5 * (value_at(profile, t_from) + value_at(profile, t_to));
  };
  double work = 0;
  for (const ForceModel& force : model.forces)
    work += mean(force.profile) *
            force.force.dot(to.position(force.point) - from.position(force.point));
  for (const MomentModel& load : model.moments) {
    const auto r = static_cast<std::size_t>(load.rigid);
    const Eigen::AngleAxisd turn(to.poses[r].R * from.poses[r].R.transpose());
    work += mean(load.profile) * turn.angle() * load.moment.dot(turn.axis());
  }
  for (const SurfaceLoadModel& load : model.surface_loads)
    work +=
        surface_work(load, from, to, value_at(load.profile, t_from), value_at(load.profile, t_to));
  const Vec3 changing = mean_changing_gravity(model, t_from, t_to);
  if (!changing.isZero(0))
    work += weight_energy(model, from, changing) - weight_energy(model, to, changing);
  return work;
}

}  // namespace articular::sim
