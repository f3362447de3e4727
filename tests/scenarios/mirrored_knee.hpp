#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "sim/scenario/scenario.hpp"
#include "tools/anatomy/anatomy.hpp"

/// A left knee of a right one: x is negated. Of a scenario, what the knees with meshes of anatomy()
/// have: lines, boxes, and probes that name places.
namespace articular::knee_test {

inline anatomy::Anatomy mirrored(anatomy::Anatomy anatomy) {
  for (auto& [name, mesh] : anatomy.meshes) {
    mesh.X_mm.row(0) *= -1;
    if (mesh.tets.cols() > 0) mesh.tets.row(0).swap(mesh.tets.row(1));
    if (mesh.triangles.cols() > 0) mesh.triangles.row(0).swap(mesh.triangles.row(1));
    if (mesh.fibres.cols() > 0) mesh.fibres.row(0) *= -1;
  }
  return anatomy;
}

inline void mirror(std::vector<sim::Anchor>& path) {
  for (sim::Anchor& anchor : path) anchor.point.x() *= -1;
}

inline void mirror(sim::JointSide& side) {
  side.origin.x() *= -1;
  side.lateral.x() *= -1;
}

inline void mirror(sim::Probe& probe) {
  if (auto* joint = std::get_if<sim::JointProbe>(&probe.what)) {
    joint->is_right = !joint->is_right;
    mirror(joint->proximal);
    mirror(joint->distal);
  }
  if (auto* point = std::get_if<sim::PointProbe>(&probe.what)) point->anchor.point.x() *= -1;
  if (auto* extent = std::get_if<sim::ExtentProbe>(&probe.what)) {
    extent->point.x() *= -1;
    extent->direction.x() *= -1;
  }
}

inline sim::Scenario mirrored(sim::Scenario scenario) {
  for (sim::Body& body : scenario.bodies)
    if (auto* box = std::get_if<sim::BoxGeometry>(&body.geometry)) box->center.x() *= -1;
  for (sim::Muscle& muscle : scenario.muscles) mirror(muscle.path);
  for (sim::Ligament& ligament : scenario.ligaments) mirror(ligament.path);
  for (sim::Probe& probe : scenario.probes) mirror(probe);
  return scenario;
}

}  // namespace articular::knee_test
