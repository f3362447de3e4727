#pragma once

#include <vtkOutputWindow.h>
#include <vtkPointSet.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>

#include "fem/base/types.hpp"
#include "sim/base/atomic_file.hpp"

/// VTK's data sets from files and into them, with our manners: quiet, errors as exceptions, files
/// whole or not at all.
namespace articular::sim {

/// While it lives, VTK prints nothing: its first error is kept instead. VTK's error output is one
/// for the whole process, so a second thread that makes one waits.
class QuietVtk {
 public:
  QuietVtk();
  ~QuietVtk();
  QuietVtk(const QuietVtk&) = delete;
  QuietVtk& operator=(const QuietVtk&) = delete;
  bool failed() const;
  std::string message() const;  // what is wrong, in one line

 private:
  class Window;
  std::unique_lock<std::recursive_mutex> only_one_;
  vtkSmartPointer<vtkOutputWindow> previous_;
  vtkSmartPointer<Window> window_;
  int previous_verbosity_;
};

/// A .vtu or .vtp with all its fields, the texts of its cells, and the first text of each array of
/// texts of the whole file, for VTK's filters. Read by read_vtk_xml().
/// @throws InputError in one line when anything is wrong with the file
vtkSmartPointer<vtkPointSet> read_vtk_file(const std::filesystem::path& file);

enum class Compressed { Yes, No };

/// A .vtu or .vtp: appended binary, with zlib or as it is. @throws SystemError
void write_vtk_file(const std::filesystem::path& file, vtkPointSet& set, Compressed compressed,
                    Durable durable = Durable::Now);

/// Points x / unit in double precision; cells as given, tetrahedra first.
vtkSmartPointer<vtkPointSet> make_grid(const Positions& x, double unit, const Tetrahedra& tets,
                                       const Triangles& triangles);
vtkSmartPointer<vtkPointSet> make_surface(const Positions& x, double unit,
                                          const Triangles& triangles);
/// A cell array with three components: one column a tetrahedron; zero for the other cells.
void add_cell_vectors(vtkPointSet& set, const std::string& name, const Eigen::Matrix3Xd& values);
/// A point array with 1 at these nodes, and 0 elsewhere.
void add_node_set(vtkPointSet& set, const std::string& name, const std::vector<int>& nodes);

}  // namespace articular::sim
