#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/mesh/vtk_xml_array.hpp"

namespace articular::sim {

/// Cells of one kind: those of cell e are nodes[begin[e]] to nodes[begin[e + 1]] (excluded).
struct VtkXmlCells {
  std::vector<std::int64_t> begin{0}, nodes;
};

struct VtkXmlField {
  std::string name;
  std::uint64_t components = 1;
  std::vector<double> values;
};

/// A text a cell, such as the names of muscles.
struct VtkXmlTexts {
  std::string name;
  std::vector<std::string> texts;
};

/// What a .vtu or .vtp holds. Several pieces are joined.
struct VtkXmlContent {
  bool is_grid = false;
  std::vector<double> points;                     // x0 y0 z0 x1 ...
  VtkXmlCells cells;                              // of a grid
  std::vector<int> types;                         // of a grid's cells, as VTK numbers them
  VtkXmlCells vertices, lines, strips, polygons;  // of a surface
  std::vector<VtkXmlField> point_fields, cell_fields;
  std::vector<VtkXmlTexts> cell_texts;  // with VtkXmlFields::All
  /// Of the whole file: names and first texts, such as {"force.unit", "N"}.
  std::vector<std::pair<std::string, std::string>> texts;
};

/// Which fields are decoded: vectors of cells and whole numbers of points, or all.
enum class VtkXmlFields { OfMeshes, All };

/// Reads .vtu (unstructured grid) and .vtp (polygonal data): text, base64 or appended data, with
/// zlib, LZ4, LZMA or without. It is read here and not by VTK, which trusts what a file claims to
/// hold: damaged ones crash it, or take its memory.
/// @throws InputError in one line for what is damaged; no byte of a file that is not XML is quoted
VtkXmlContent read_vtk_xml(const std::filesystem::path& file, VtkXmlFields fields);

}  // namespace articular::sim
