#include "sim/mesh/vtk_files.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cstdint>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "sim/mesh/vtk_xml_file.hpp"

namespace articular::sim {
namespace {

vtkSmartPointer<vtkCellArray> make_cells(const VtkXmlCells& cells) {
  auto array = vtkSmartPointer<vtkCellArray>::New();
  for (std::size_t e = 0; e + 1 < cells.begin.size(); ++e) {
    array->InsertNextCell(static_cast<int>(cells.begin[e + 1] - cells.begin[e]));
    for (std::int64_t i = cells.begin[e]; i < cells.begin[e + 1]; ++i)
      array->InsertCellPoint(cells.nodes[static_cast<std::size_t>(i)]);
  }
  return array;
}

void add_fields(const std::vector<VtkXmlField>& fields, vtkDataSetAttributes& to) {
  for (const VtkXmlField& field : fields) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(field.name.c_str());
    array->SetNumberOfComponents(static_cast<int>(field.components));
    array->SetNumberOfTuples(static_cast<vtkIdType>(field.values.size() / field.components));
    std::copy(field.values.begin(), field.values.end(), array->GetPointer(0));
    to.AddArray(array);
  }
}

vtkSmartPointer<vtkPointSet> make_cells_of(const VtkXmlContent& content) {
  if (content.is_grid) {
    vtkNew<vtkUnsignedCharArray> types;
    for (const int type : content.types)
      types->InsertNextValue(static_cast<unsigned char>(std::clamp(type, 0, 255)));
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetCells(types, make_cells(content.cells));
    return grid;
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetVerts(make_cells(content.vertices));
  surface->SetLines(make_cells(content.lines));
  surface->SetPolys(make_cells(content.polygons));
  surface->SetStrips(make_cells(content.strips));
  return surface;
}

template <class Writer>
std::string to_xml(vtkPointSet& set, Compressed compressed) {
  vtkNew<Writer> writer;
  writer->SetInputData(&set);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  if (compressed == Compressed::Yes)
    writer->SetCompressorTypeToZLib();
  else
    writer->SetCompressorTypeToNone();
  writer->SetWriteToOutputString(true);
  writer->Write();
  return writer->GetOutputString();
}

vtkSmartPointer<vtkPoints> make_points(const Positions& x, double unit) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(x.cols());
  for (Eigen::Index a = 0; a < x.cols(); ++a) {
    const Vec3 p = x.col(a) / unit;
    points->SetPoint(a, p.data());
  }
  return points;
}

/// 32-bit indices: half the size in memory and before compression.
template <class Cells>
void insert(vtkCellArray& array, const Cells& cells) {
  for (Eigen::Index e = 0; e < cells.cols(); ++e) {
    array.InsertNextCell(static_cast<int>(cells.rows()));
    for (const int a : cells.col(e)) array.InsertCellPoint(a);
  }
}

void add_texts(const std::string& name, const std::vector<std::string>& texts, vtkFieldData& data) {
  vtkNew<vtkStringArray> array;
  array->SetName(name.c_str());
  for (const std::string& text : texts) array->InsertNextValue(text);
  data.AddArray(array);
}

std::recursive_mutex& error_output() {
  static std::recursive_mutex mutex;
  return mutex;
}

}  // namespace

/// Keeps the first error that VTK would print; warnings are dropped.
class QuietVtk::Window : public vtkOutputWindow {
 public:
  static Window* New() {
    auto* const window = new Window;
    window->InitializeObjectBase();
    return window;
  }
  void DisplayText(const char*) override {}
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayErrorText(const char* text) override {
    if (first_error.empty()) first_error = text;
  }
  std::string first_error;
};

QuietVtk::QuietVtk()
    : only_one_(error_output()),
      previous_(vtkOutputWindow::GetInstance()),
      window_(vtkSmartPointer<Window>::New()),
      previous_verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
  vtkOutputWindow::SetInstance(window_);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // it prints beside the window
}

QuietVtk::~QuietVtk() {
  vtkOutputWindow::SetInstance(previous_);
  vtkLogger::SetStderrVerbosity(static_cast<vtkLogger::Verbosity>(previous_verbosity_));
}

bool QuietVtk::failed() const { return !window_->first_error.empty(); }

std::string QuietVtk::message() const {
  // VTK's form is "ERROR: In FILE, line N\nCLASS (ADDRESS): what is wrong\n\n".
  std::string text = window_->first_error;
  const std::size_t start = text.find("): ");
  if (start != std::string::npos) text.erase(0, start + 3);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0)
    text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

vtkSmartPointer<vtkPointSet> read_vtk_file(const std::filesystem::path& file) {
  const VtkXmlContent content = read_vtk_xml(file, VtkXmlFields::All);
  vtkSmartPointer<vtkPointSet> set = make_cells_of(content);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(content.points.size() / 3));
  for (vtkIdType a = 0; a < points->GetNumberOfPoints(); ++a)
    points->SetPoint(a, content.points.data() + 3 * a);
  set->SetPoints(points);
  add_fields(content.point_fields, *set->GetPointData());
  add_fields(content.cell_fields, *set->GetCellData());
  for (const VtkXmlTexts& array : content.cell_texts)
    add_texts(array.name, array.texts, *set->GetCellData());
  for (const auto& [name, text] : content.texts) add_texts(name, {text}, *set->GetFieldData());
  return set;
}

void write_vtk_file(const std::filesystem::path& file, vtkPointSet& set, Compressed compressed,
                    Durable durable) {
  const QuietVtk vtk;
  const std::string xml = set.IsA("vtkPolyData") != 0
                              ? to_xml<vtkXMLPolyDataWriter>(set, compressed)
                              : to_xml<vtkXMLUnstructuredGridWriter>(set, compressed);
  if (vtk.failed() || xml.empty())
    throw SystemError(file.string() + ": can't be written: " + vtk.message());
  write_text_file(file, xml, durable);
}

vtkSmartPointer<vtkPointSet> make_grid(const Positions& x, double unit, const Tetrahedra& tets,
                                       const Triangles& triangles) {
  vtkNew<vtkCellArray> cells;
  cells->Use32BitStorage();
  insert(*cells, tets);
  insert(*cells, triangles);
  vtkNew<vtkUnsignedCharArray> types;
  types->SetNumberOfValues(cells->GetNumberOfCells());
  for (vtkIdType e = 0; e < cells->GetNumberOfCells(); ++e)
    types->SetValue(e, e < tets.cols() ? VTK_TETRA : VTK_TRIANGLE);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(make_points(x, unit));
  grid->SetCells(types, cells);
  return grid;
}

vtkSmartPointer<vtkPointSet> make_surface(const Positions& x, double unit,
                                          const Triangles& triangles) {
  vtkNew<vtkCellArray> cells;
  cells->Use32BitStorage();
  insert(*cells, triangles);
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(make_points(x, unit));
  surface->SetPolys(cells);
  return surface;
}

void add_cell_vectors(vtkPointSet& set, const std::string& name, const Eigen::Matrix3Xd& values) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(set.GetNumberOfCells());
  array->Fill(0);
  for (Eigen::Index e = 0; e < values.cols(); ++e) array->SetTuple(e, values.col(e).data());
  set.GetCellData()->AddArray(array);
}

void add_node_set(vtkPointSet& set, const std::string& name, const std::vector<int>& nodes) {
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfTuples(set.GetNumberOfPoints());
  array->Fill(0);
  for (const int node : nodes) array->SetValue(node, 1);
  set.GetPointData()->AddArray(array);
}

}  // namespace articular::sim
