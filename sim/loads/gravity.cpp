#include "sim/loads/gravity.hpp"

#include "sim/scenario/curve.hpp"

namespace articular::sim {

Vec3 gravity_at(const Model& model, double t) {
  Vec3 sum = Vec3::Zero();
  for (const GravityModel& gravity : model.gravity)
    sum += value_at(gravity.profile, t) * gravity.acceleration;
  return sum;
}

Vec3 steady_gravity(const Model& model) {
  Vec3 sum = Vec3::Zero();
  for (const GravityModel& gravity : model.gravity)
    if (gravity.profile.time.empty()) sum += gravity.acceleration;
  return sum;
}

Vec3 mean_changing_gravity(const Model& model, double t_from, double t_to) {
  Vec3 sum = Vec3::Zero();
  for (const GravityModel& gravity : model.gravity)
    if (!gravity.profile.time.empty())
      sum += 0.5 * (value_at(gravity.profile, t_from) + value_at(gravity.profile, t_to)) *
             gravity.acceleration;
  return sum;
}

}  // namespace articular::sim
