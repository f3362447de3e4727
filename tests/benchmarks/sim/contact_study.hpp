#pragma once

#include "tests/benchmarks/sim/contact_scene.hpp"

/// Static studies that verify contact; each prints one table, in markdown.
namespace articular::sim {

/// Two tissue blocks, or a block and a plate, pressed together; of the exact pressure [%].
struct PatchResult {
  double mean = 0;       // from the exact one
  double deviation = 0;  // of σ_zz from the mean, largest
  double nodal = 0;      // half the range of the pressure at nodes
  Costs costs;
};
/// @param part  of a cell that nodes are displaced by
PatchResult press_blocks(int lower, int upper, double part, const StudyOptions& options);

/// A normal force on a way across a mesh; half its range over the mean [%], as it is and without
/// the parabola that the block's size gives.
struct Ripple {
  double mean = 0, raw = 0, detrended = 0;  // [N], [%], [%]
  double penetration = 0;                   // [m]
  Costs costs;
};
Ripple drag_sphere(int cells, double part, const StudyOptions& options);

/// A layer on bone under a sphere.
struct LayerResult {
  double force = 0, peak = 0, penetration = 0;  // [N], [Pa], [m]
  Costs costs;
};
LayerResult press_layer(int elements, double nu, const StudyOptions& options);

void study_responses(const StudyOptions& options);
void study_patch(const StudyOptions& options);
void study_drag(const StudyOptions& options);
void study_hertz(const StudyOptions& options);
void study_cylinders(const StudyOptions& options);
void study_layer(const StudyOptions& options);
void study_lines(const StudyOptions& options);
void study_pressure(const StudyOptions& options);

}  // namespace articular::sim
