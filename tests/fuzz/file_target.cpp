// Meshes, models, series of frames, tables, checkpoints and records of studies: read or refused.
// The first byte says which.
#include <cstdlib>
#include <cstring>
#include <string>

#include "sim/base/file_bytes.hpp"
#include "sim/base/hash.hpp"
#include "sim/mesh/febio_mesh.hpp"
#include "sim/mesh/frame_series.hpp"
#include "sim/mesh/mesh_io.hpp"
#include "sim/mesh/vtk_xml_file.hpp"
#include "sim/output/checkpoint.hpp"
#include "sim/scenario/motion_table.hpp"
#include "sim/scenario/muscle_table.hpp"
#include "tests/fuzz/input.hpp"
#include "tools/import/febio_scenario.hpp"
#include "tools/study/study_record.hpp"
#include "tools/study/study_values.hpp"

using namespace articular;

namespace {

void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "not as it should be: %s\n", what);
  std::abort();
}

template <const char* name>
void read_mesh(std::string_view bytes) {
  const sim::MeshData mesh = sim::read_mesh(fuzz::as_file(name, bytes), 1e-3);
  expect(mesh.X.allFinite(), "positions are finite");
  const auto are_nodes = [&](const auto& cells) {
    return cells.size() == 0 || (cells.minCoeff() >= 0 && cells.maxCoeff() < mesh.X.cols());
  };
  expect(are_nodes(mesh.tets) && are_nodes(mesh.triangles), "cells refer to nodes");
  for (const sim::MeshSet& set : mesh.sets) {
    for (const int a : set.nodes) expect(a >= 0 && a < mesh.X.cols(), "sets have nodes");
    for (const int t : set.tets) expect(t >= 0 && t < mesh.tets.cols(), "sets have tetrahedra");
    for (const auto& face : set.faces)
      for (const int a : face) expect(a >= 0 && a < mesh.X.cols(), "faces of sets have nodes");
  }
  for (const auto& [field, values] : mesh.cell_vectors)
    expect(values.cols() == mesh.tets.cols(), "each tetrahedron has a vector");
}

/// The elements of a mesh, with nodes that are there, or the nodes with elements.
template <const char* name>
void read_tetgen(std::string_view bytes) {
  fuzz::as_file("tetgen.node", "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n");
  fuzz::as_file("tetgen.ele", "2 4 1\n1 1 2 3 4 1\n2 2 3 4 5 2\n");
  read_mesh<name>(bytes);
}

/// A model of FEBio, to a scenario.
void import_febio(std::string_view bytes) {
  const sim::XmlElement document = sim::read_xml_tree("model.feb", ".feb", bytes);
  const sim::MeshData mesh = sim::febio_mesh("model.feb", document);
  const tools::FebioModel model = tools::read_febio_model("model.feb", document);
  tools::scenario_of("model.feb", model, mesh, tools::unit_system("SI"), "model.feb");
}

/// As a mesh, and with all fields, as results are read.
template <const char* name>
void read_xml_mesh(std::string_view bytes) {
  sim::read_vtk_xml(fuzz::as_file(name, bytes), sim::VtkXmlFields::All);
  read_mesh<name>(bytes);
}

void read_series(std::string_view bytes) { sim::read_series(fuzz::as_file("run.pvd", bytes)); }

void read_motion(std::string_view bytes) {
  sim::read_motion_table(fuzz::as_file("motion.csv", bytes), {"scenario.toml", 1, 1});
}

void read_muscles(std::string_view bytes) {
  sim::read_muscle_table(fuzz::as_file("muscles.csv", bytes), {"scenario.toml", 1, 1});
}

void read_history(std::string_view bytes) {
  try {
    const tools::RunHistory history = tools::read_history(fuzz::as_file("history.csv", bytes));
    tools::StudyOutput output;
    output.column = history.names.back();
    for (const auto value : {tools::StudyValue::Change, tools::StudyValue::Mean}) {
      output.value = value;
      tools::output_value(output, history, "study.toml");
    }
  } catch (const sim::SystemError& error) {
    fuzz::expect_readable(error.what());  // a run that was told to write it left none
  }
}

const std::string kFingerprint = "0123456789abcdef";

void read_checkpoint(std::string_view bytes) {
  const std::filesystem::path file = fuzz::as_file("state.bin", bytes);
  sim::read_checkpoint(file.parent_path(), kFingerprint, [](const std::string&) {});
}

/// How every checkpoint begins.
std::string checkpoint_head() {
  const std::filesystem::path file = fuzz::as_file("state.bin", "");
  sim::write_checkpoint(file.parent_path(), {}, kFingerprint);
  const std::string whole = sim::file_bytes(file);
  return whole.substr(0, whole.find(kFingerprint) + kFingerprint.size());
}

/// With the head and the checksum that it should have: else what was changed is read no further.
void read_sound_checkpoint(std::string_view bytes) {
  static const std::string head = checkpoint_head();
  std::string sound = head + std::string(bytes);
  const std::uint64_t hash = sim::hash_bytes(sound);
  sound.append(reinterpret_cast<const char*>(&hash), sizeof hash);
  read_checkpoint(sound);
}

void read_record(std::string_view bytes) {
  tools::read_record(fuzz::as_file("record.json", bytes), "key");
}

constexpr char kVtu[] = "mesh.vtu", kVtp[] = "mesh.vtp", kVtk[] = "mesh.vtk", kStl[] = "mesh.stl",
               kObj[] = "mesh.obj", kPly[] = "mesh.ply", kInp[] = "mesh.inp", kMsh[] = "mesh.msh",
               kFeb[] = "mesh.feb", kBdf[] = "mesh.bdf", kMedit[] = "medit.mesh",
               kEle[] = "tetgen.ele", kNode[] = "tetgen.node";

/// The first is for any other byte. `run` puts these in front of the files of `seeds`.
constexpr struct {
  char letter;
  void (*read)(std::string_view bytes);
} kReaders[] = {{'u', read_xml_mesh<kVtu>},   {'p', read_xml_mesh<kVtp>}, {'k', read_mesh<kVtk>},
                {'s', read_mesh<kStl>},       {'o', read_mesh<kObj>},     {'y', read_mesh<kPly>},
                {'F', import_febio},          {'i', read_mesh<kInp>},     {'g', read_mesh<kMsh>},
                {'f', read_mesh<kFeb>},       {'n', read_mesh<kBdf>},     {'e', read_mesh<kMedit>},
                {'t', read_tetgen<kEle>},     {'T', read_tetgen<kNode>},  {'d', read_series},
                {'m', read_motion},           {'M', read_muscles},        {'h', read_history},
                {'c', read_sound_checkpoint}, {'C', read_checkpoint},     {'r', read_record}};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto* reader = std::begin(kReaders);
  for (const auto& known : kReaders)
    if (known.letter == static_cast<char>(data[0])) reader = &known;
  fuzz::read_or_refused([&] { reader->read(fuzz::as_text(data + 1, size - 1)); });
  return 0;
}
