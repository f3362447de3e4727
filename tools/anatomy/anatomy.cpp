#include "tools/anatomy/anatomy.hpp"

#include "sim/base/atomic_file.hpp"
#include "sim/mesh/mesh_io.hpp"
#include "sim/output/frame_writer.hpp"

namespace articular::anatomy {
namespace {

constexpr double kMillimetre = 1e-3;  // [m]

}  // namespace

void write_anatomy(const Anatomy& anatomy, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const auto& [name, mesh] : anatomy.meshes) {
    sim::MeshData data;
    data.X = mesh.X_mm * kMillimetre;
    data.tets = mesh.tets;
    data.triangles = mesh.triangles;
    if (mesh.fibres.cols() > 0) data.cell_vectors.emplace_back("fibres", mesh.fibres);
    sim::write_mesh(folder / name, data, kMillimetre);
  }
  if (!anatomy.muscles.empty())
    sim::write_text_file(folder / "muscles.csv", muscles_csv(anatomy.muscles));
  sim::write_text_file(folder / "landmarks.csv", landmarks_csv(anatomy.landmarks));
}

}  // namespace articular::anatomy
