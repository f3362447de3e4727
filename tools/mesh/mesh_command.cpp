#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "sim/base/error.hpp"
#include "sim/scenario/quantity.hpp"
#include "tools/mesh/mesh_command.hpp"
#include "tools/mesh/mesh_quality.hpp"
#include "tools/process/interruption.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

struct MeshOptions {
  fs::path surface, out;
  std::string size, unit = "mm", distance, edges;
  bool crossings = false, split = false;
};

/// @throws InputError naming the option
template <class Parse>
double parsed(const char* option, const Parse& parse) {
  try {
    return parse();
  } catch (const std::invalid_argument& error) {
    throw sim::InputError(fmt::format("{}: {}", option, error.what()));
  }
}

double parse_length(const char* option, const std::string& text) {
  const double length = parsed(option, [&] { return sim::parse_quantity(text, sim::kLength); });
  if (length <= 0) throw sim::InputError(fmt::format("{}: expected a length > 0", option));
  return length;
}

MesherSettings mesher_settings(const MeshOptions& options) {
  constexpr double kDistancePerSize = 0.1;
  constexpr double kDegree = 3.14159265358979323846 / 180;
  MesherSettings settings;
  settings.size = parse_length("--size", options.size);
  settings.distance = options.distance.empty() ? kDistancePerSize * settings.size
                                               : parse_length("--distance", options.distance);
  if (!options.edges.empty()) {
    settings.sharp_edges_deg =
        parsed("--edges", [&] { return sim::parse_quantity(options.edges, sim::kAngle); }) /
        kDegree;
    if (settings.sharp_edges_deg <= 0 || settings.sharp_edges_deg >= 180)
      throw sim::InputError("--edges: expected an angle between 0 and 180 deg");
  }
  settings.crossings = options.crossings;
  return settings;
}

/// Looked at first: meshing may take minutes.
void check_target(const fs::path& out) {
  if (out.extension() != ".vtu")
    throw sim::InputError({out.string()}, "--out: expected a file that ends in .vtu");
  const fs::path folder = out.parent_path();
  std::error_code error;
  if (!folder.empty() && !fs::is_directory(folder, error))
    throw sim::SystemError(out.string() + ": can't be written: there is no folder " +
                           folder.string());
}

void tell_stray(const std::string& name, const StrayShell& stray) {
  fmt::print(stderr,
             "{}: dropped a stray shell of {} faces at face {}, which encloses less than "
             "an element\n",
             name, stray.faces, stray.first_face + 1);
}

void print_quality(const MeshQuality& quality, const TetMesh& mesh, const Shell& shell,
                   const std::string& unit_name, double unit) {
  fmt::print("  {} nodes ({} inside), {} tetrahedra, mean edge {:.3g} {}\n", mesh.X.cols(),
             quality.inner_nodes, mesh.tets.cols(), quality.mean_edge / unit, unit_name);
  fmt::print(
      "  dihedral angles: least {:.1f} deg, median of the tetrahedra's least {:.1f} deg; "
      "{} tetrahedra below 10 deg\n",
      quality.least_dihedral_deg, quality.median_dihedral_deg, quality.tets_below_10_deg);
  const double cubic = unit * unit * unit;
  fmt::print(
      "  volume {:.5g} {}^3, the surface's {:.5g} ({:+.2f} %); distance between the surfaces "
      "at most {:.3g} {}\n",
      quality.volume / cubic, unit_name, shell.volume / cubic,
      100 * (quality.volume / shell.volume - 1), quality.largest_distance / unit, unit_name);
}

/// "knee.vtu" -> "knee_2.vtu"
fs::path numbered(const fs::path& out, std::size_t number) {
  return out.parent_path() / fmt::format("{}_{}.vtu", out.stem().string(), number);
}

void append(sim::MeshData& all, const TetMesh& mesh) {
  const Eigen::Index nodes = all.X.cols(), tets = all.tets.cols();
  all.X.conservativeResize(3, nodes + mesh.X.cols());
  all.X.rightCols(mesh.X.cols()) = mesh.X;
  all.tets.conservativeResize(4, tets + mesh.tets.cols());
  all.tets.rightCols(mesh.tets.cols()) = mesh.tets.array() + static_cast<int>(nodes);
}

int mesh(const MeshOptions& options) {
  const double unit = parsed("--unit", [&] { return sim::parse_unit(options.unit, sim::kLength); });
  const MesherSettings settings = mesher_settings(options);
  check_target(options.out);
  const std::string name = options.surface.string();
  const sim::MeshData surface = sim::read_mesh(options.surface, unit);
  if (surface.tets.cols() > 0)
    throw sim::InputError({name}, "holds tetrahedra; expected a surface of triangles");
  const Shells shells = closed_shells(name, surface, unit, settings.size);
  for (const StrayShell& stray : shells.stray) tell_stray(name, stray);

  // Nothing is written before every shell has its mesh.
  std::vector<TetMesh> meshes;
  try {
    for (const Shell& shell : shells.shells)
      meshes.push_back(mesh_shell(name, shell, unit, settings, interruption_asked));
  } catch (const MeshingInterrupted&) {
    fmt::print(stderr, "articular: interrupted; nothing was written\n");
    return kInterruptedExitCode;
  }
  std::vector<sim::MeshData> files(options.split ? meshes.size() : 1);
  for (std::size_t i = 0; i < meshes.size(); ++i) append(files[options.split ? i : 0], meshes[i]);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const fs::path file = options.split ? numbered(options.out, i + 1) : options.out;
    sim::write_mesh(file, files[i], unit);
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (options.split || i == 0)
      fmt::print("{}\n", (options.split ? numbered(options.out, i + 1) : options.out).string());
    const MeshQuality quality = mesh_quality(meshes[i], shells.shells[i]);
    print_quality(quality, meshes[i], shells.shells[i], options.unit, unit);
    if (quality.parts > 1)
      fmt::print(stderr,
                 "{}: the shell of face {} fell into {} parts: it is thinner than the "
                 "elements somewhere; a smaller --size keeps it whole\n",
                 name, shells.shells[i].face_numbers[0] + 1, quality.parts);
  }
  return 0;
}

const char* const kMeshHelp =
    R"(The surface has to be closed; which way it looks doesn't matter. Shells that enclose less than
an element are dropped, and stderr says so. The file is written in the unit of the surface. Meshes
of one surface may differ in a few tetrahedra of a thousand from one time to the next.

Example: cartilage of two plateaus, one file each (tibcart_1.vtu, tibcart_2.vtu)
  articular mesh tibcart.obj --size "2 mm" --split --out tibcart.vtu)";

}  // namespace

void add_mesh_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<MeshOptions>();
  CLI::App& command = *app.add_subcommand("mesh", "Fills closed surfaces with tetrahedra");
  command.add_option("surface", options->surface, ".obj, .stl, .ply, .vtp or .vtk with triangles")
      ->required()
      ->type_name("SURFACE");
  command.add_option("--size", options->size, "Mean edge of the tetrahedra, such as \"1.5 mm\"")
      ->required()
      ->type_name("LENGTH");
  command.add_option("--out", options->out, "The tetrahedra, a .vtu")
      ->required()
      ->type_name("FILE");
  command.add_option("--unit", options->unit, "Length unit of the surface's file [mm]")
      ->type_name("UNIT");
  command
      .add_option("--distance", options->distance,
                  "How far a facet may be from the surface [a tenth of the size]")
      ->type_name("LENGTH");
  command
      .add_option("--edges", options->edges,
                  "Keep edges where the surface turns by more, such as \"40 deg\" [none]; not "
                  "for scans, where roughness counts as edges")
      ->type_name("ANGLE");
  command.add_flag(
      "--crossings", options->crossings,
      "Take a surface that crosses itself as it is: inside is what a ray leaves an odd "
      "number of times");
  command.add_flag("--split", options->split, "One file a shell: FILE_1.vtu, FILE_2.vtu, ...");
  command.footer(kMeshHelp);
  command.callback([options, &exit_code] {
    listen_for_interruption();  // the mesher ends with this program
    exit_code = mesh(*options);
  });
}

}  // namespace articular::tools
