#include <pybind11/stl.h>

#include <mutex>
#include <stdexcept>

#include "collision/blocks/block_collide.hpp"
#include "tools/python/core/arrays.hpp"
#include "tools/python/core/bindings.hpp"

namespace articular::python {
namespace {

using collision::Penetration;

/// A mesh of tetrahedra in the tree that finds what meets it.
class Collider {
 public:
  Collider(const Positions& points, Tetrahedra tets)
      : tets_(std::move(tets)),
        surface_(collision::build_surface(tets_, static_cast<int>(points.cols()))),
        tree_(tets_, surface_, points) {
    tree_.update(points);
  }

  const Tetrahedra& tets() const { return tets_; }
  const collision::Surface& surface() const { return surface_; }
  Eigen::Index num_nodes() const { return tree_.num_user_nodes(); }

  void update(const Positions& points, double margin) {
    const py::gil_scoped_release release;
    const std::lock_guard lock(in_use_);
    tree_.update(points, margin);
  }

  /// Faces of this one in tetrahedra of another, by face and tetrahedron.
  std::vector<Penetration> pairs_in(Collider& other) {
    const py::gil_scoped_release release;
    std::vector<Penetration> pairs;
    if (this == &other) {
      const std::lock_guard lock(in_use_);
      faces_in_own_body(tree_, pairs, counts_, scratch_);
      sort(pairs, other);
    } else {
      const std::scoped_lock lock(in_use_, other.in_use_);
      faces_in_body(tree_, other.tree_, pairs, counts_, scratch_);
      sort(pairs, other);
    }
    return pairs;
  }

 private:
  void sort(std::vector<Penetration>& pairs, const Collider& other) {
    collision::SortScratch scratch;
    collision::sort_pairs(pairs, tree_, other.tree_, scratch);
  }

  Tetrahedra tets_;
  collision::Surface surface_;
  collision::BlockTree tree_;
  collision::BlockQueryScratch scratch_;
  collision::BlockQueryCounts counts_;
  std::mutex in_use_;
};

py::array rows_of(const std::vector<Penetration>& pairs) {
  Eigen::Matrix2Xi rows(2, static_cast<Eigen::Index>(pairs.size()));
  for (Eigen::Index i = 0; i < rows.cols(); ++i) {
    const Penetration& pair = pairs[static_cast<std::size_t>(i)];
    rows.col(i) = Eigen::Vector2i(pair.face, pair.tetrahedron);
  }
  return copy_of(rows);
}

}  // namespace

void bind_collision(py::module_& module) {
  py::module_ part = module.def_submodule("collision");
  py::class_<Collider>(part, "Collider",
                       R"(A mesh of tetrahedra that finds what meets it, while it moves.

Lengths have the unit of the points. Inverted and flat tetrahedra are allowed.)")
      .def(py::init([](const py::object& points, const py::object& tetrahedra) {
             return std::make_unique<Collider>(positions_from(points, "points"),
                                               tetrahedra_from(tetrahedra, "tetrahedra"));
           }),
           py::arg("points"), py::arg("tetrahedra"),
           R"(points: (N, 3). tetrahedra: (M, 4) numbers of points from 0.

Raises ValueError for other shapes, points that are not finite, points that there are not, and faces of more
than two tetrahedra.)")
      .def_property_readonly(
          "tetrahedra",
          [](const py::object& self) { return view_of(self.cast<Collider&>().tets(), self); },
          "(M, 4), read-only, no copy.")
      .def_property_readonly(
          "faces",
          [](const py::object& self) {
            return view_of(self.cast<Collider&>().surface().faces, self);
          },
          "Surface triangles, counterclockwise from outside: (F, 3), read-only, no copy.")
      .def_property_readonly(
          "face_tetrahedra", [](const Collider& self) { return copy_of(self.surface().face_tet); },
          "The tetrahedron of each face: (F,).")
      .def(
          "update",
          [](Collider& self, const py::object& points, double margin) {
            self.update(positions_from(points, "points", self.num_nodes()), margin);
          },
          py::arg("points"), py::arg("margin") = 0.0,
          R"(Follows the mesh to new points, (N, 3).

margin: from now on all pairs nearer than this are found too, and near edges some that are a little farther. Two
meshes must have the same.)")
      .def(
          "pairs_in", [](Collider& self, Collider& other) { return rows_of(self.pairs_in(other)); },
          py::arg("other"),
          R"(Faces of this mesh that meet tetrahedra of another: rows (face, tetrahedron), (P, 2), sorted.

Of the mesh with itself, without pairs that have a common node.)");
}

}  // namespace articular::python
