#include "sim/mesh/vtk_files.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"

namespace articular::sim {
namespace {

constexpr std::array<std::string_view, 3> kEndings = {".vtu", ".vtp", ".stl"};

/// VTK reads any bytes as triangles, so the count in a binary file is held against its size here.
void check_stl(const std::string& file) {
  constexpr std::uintmax_t kHeader = 84, kTriangle = 50;  // [byte]
  std::array<char, kHeader> header{};
  std::ifstream(file, std::ios::binary).read(header.data(), kHeader);
  const std::string_view text(header.data(), header.size());
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && text.substr(first).starts_with("solid")) return;
  std::uint32_t count = 0;
  std::memcpy(&count, header.data() + 80, sizeof count);
  if (std::filesystem::file_size(file) < kHeader + kTriangle * count)
    throw InputError({file},
                     "not readable as .stl: neither text (`solid ...`) nor as long as its " +
                         std::to_string(count) + " triangles");
}

/// VTK trusts the offsets of a file; a mesh must not be walked before they are known to be sound.
bool is_sound(vtkCellArray* cells) {
  if (cells == nullptr) return true;
  vtkDataArray* const offsets = cells->GetOffsetsArray();
  double previous = 0;
  for (vtkIdType i = 0; i < offsets->GetNumberOfTuples(); ++i) {
    const double offset = offsets->GetComponent(i, 0);
    if (offset < previous) return false;
    previous = offset;
  }
  return previous <= static_cast<double>(cells->GetNumberOfConnectivityIds());
}

template <class Reader>
vtkSmartPointer<vtkPointSet> read_with(const std::string& file) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
}

template <class Writer>
std::string to_xml(vtkPointSet& set) {
  vtkNew<Writer> writer;
  writer->SetInputData(&set);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
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

bool is_vtk_file_ending(std::string_view ending) {
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

vtkSmartPointer<vtkPointSet> read_vtk_file(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (!is_vtk_file_ending(ending)) throw InputError({name}, "expected a file .vtu, .vtp or .stl");
  if (ending == ".stl") check_stl(name);
  const QuietVtk vtk;
  vtkSmartPointer<vtkPointSet> set = ending == ".vtu"
                                         ? read_with<vtkXMLUnstructuredGridReader>(name)
                                     : ending == ".vtp" ? read_with<vtkXMLPolyDataReader>(name)
                                                        : read_with<vtkSTLReader>(name);
  if (vtk.failed()) throw InputError({name}, "not readable as " + ending + ": " + vtk.message());
  if (set == nullptr)
    throw InputError(
        {name}, "not readable as " + ending + ": expected an unstructured grid or polygonal data");
  auto* const grid = vtkUnstructuredGrid::SafeDownCast(set);
  auto* const surface = vtkPolyData::SafeDownCast(set);
  if (grid == nullptr && surface == nullptr)
    throw InputError({name}, std::string("holds a ") + set->GetClassName() +
                                 "; expected an unstructured grid or polygonal data");
  const bool sound = grid != nullptr
                         ? is_sound(grid->GetCells())
                         : is_sound(surface->GetPolys()) && is_sound(surface->GetStrips());
  if (!sound)
    throw InputError({name}, "not readable as " + ending + ": the cells' offsets do not ascend");
  return set;
}

void write_vtk_file(const std::filesystem::path& file, vtkPointSet& set, Durable durable) {
  const QuietVtk vtk;
  const std::string xml = set.IsA("vtkPolyData") != 0 ? to_xml<vtkXMLPolyDataWriter>(set)
                                                      : to_xml<vtkXMLUnstructuredGridWriter>(set);
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

}  // namespace articular::sim
