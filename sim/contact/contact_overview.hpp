#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "sim/model/model.hpp"

/// What is to be known of contact before a run.
namespace articular::sim {

/// One pair of bodies at the start.
struct ContactOverview {
  ContactId contact = 0;
  /// [m] of a node of either from the other's surface, the least; what is tied to the other does
  /// not count. Infinite of a body with itself, and where all is tied.
  double distance = std::numeric_limits<double>::infinity();
  Vec3 place = Vec3::Zero();  // that node [m]
  bool can_move = true;       // against each other
  int num_tied_nodes = 0;     // of tissue, on the other body
  int num_tied_faces = 0;     // with such a node: they do not touch the other body
  /// Faces of that tissue that may touch the body that it is tied to, and of these those that lie
  /// within half an element of it.
  int num_free_faces = 0, num_close_faces = 0;
};
/// Of more contacts than kMostOverviews only those of bodies whose boxes are nearer than an element
/// of either.
inline constexpr std::int64_t kMostOverviews = 1000;
std::vector<ContactOverview> contact_overviews(const Model& model);

/// The elements of a body's surface.
struct SurfaceOverview {
  int body = 0;
  double edge = 0;    // [m] mean
  double height = 0;  // [m] mean of the elements under the faces
  int num_faces = 0;
  int num_flat = 0;              // height below a fifth of the longest edge
  Vec3 flattest = Vec3::Zero();  // middle of that face [m]
};
/// Of the bodies that may touch.
std::vector<SurfaceOverview> surface_overviews(const Model& model);

}  // namespace articular::sim
