#pragma once
// Interface sketch; see collision/collide.hpp. The owner of the module completes the class.

#include <Eigen/Core>
#include <memory>

#include "collision/surface.hpp"

namespace articular::collision {

struct BucketTreeOptions {
  double bucket_ratio = 1.5;  // n of Eq. 1.5.6: bucket edge / mean tetrahedron diameter
};

class BucketTree;

}  // namespace articular::collision
