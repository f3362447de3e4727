#include "tools/anatomy/anatomy_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>

#include "sim/base/error.hpp"
#include "tools/anatomy/anatomy.hpp"
#include "tools/anatomy/anatomy_knee.hpp"
#include "tools/anatomy/anatomy_mandible.hpp"

namespace articular::anatomy {
namespace {

template <class Build>
void make_files(const Build& build, const std::filesystem::path& folder) {
  try {
    const Anatomy anatomy = build();
    write_anatomy(anatomy, folder);
    for (const auto& [name, mesh] : anatomy.meshes)
      fmt::print("{}: {} nodes, {} {}\n", (folder / name).string(), mesh.X_mm.cols(),
                 mesh.tets.cols() > 0 ? mesh.tets.cols() : mesh.triangles.cols(),
                 mesh.tets.cols() > 0 ? "tetrahedra" : "triangles");
    if (!anatomy.muscles.empty())
      fmt::print("{}: {} muscles\n", (folder / "muscles.csv").string(), anatomy.muscles.size());
    fmt::print("{}: {} points\n", (folder / "landmarks.csv").string(), anatomy.landmarks.size());
  } catch (const std::invalid_argument& error) {
    throw sim::InputError(error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    throw sim::SystemError(error.what());
  }
}

void add_mandible(CLI::App& anatomy, int& exit_code) {
  CLI::App* mandible = anatomy.add_subcommand(
      "mandible", "Jaw: mandible, skull parts, joint surfaces, discs, muscle attachments");
  struct Options {
    double size_mm = 1.2;
    bool muscles = false;
    double muscle_size_mm = 4;
    double scale = 1, slope_deg = kSlopeDeg, guidance_deg = kGuidanceDeg;
    std::filesystem::path folder;
  };
  const auto options = std::make_shared<Options>();
  mandible->add_option("--size", options->size_mm, "Element size of the discs in mm (0.3 to 2.5)")
      ->capture_default_str();
  CLI::Option* muscles = mandible->add_flag(
      "--muscles", options->muscles,
      "Adds both parts of the masseter, temporalis, medial and inferior lateral pterygoid of both "
      "sides as tissue with fibres, and the bone they touch");
  mandible
      ->add_option("--muscle-size", options->muscle_size_mm,
                   "Element size of the muscles in mm (3 to 6)")
      ->needs(muscles)
      ->capture_default_str();
  mandible->add_option("--scale", options->scale, "Factor of all lengths (0.75 to 1.3)")
      ->capture_default_str();
  mandible
      ->add_option("--slope", options->slope_deg,
                   "Slope of the articular eminence in degrees (30 to 55)")
      ->excludes(muscles)
      ->capture_default_str();
  mandible
      ->add_option("--guidance", options->guidance_deg,
                   "Slope of the inner faces of the upper incisors in degrees (40 to 65)")
      ->capture_default_str();
  mandible->add_option("--out", options->folder, "Folder for the files, made if it is not there")
      ->required()
      ->type_name("DIR");
  mandible->callback([options, &exit_code] {
    const auto build = [&] {
      Anatomy result =
          mandible_anatomy(options->size_mm, options->slope_deg, options->guidance_deg);
      if (options->muscles) add_muscle_bodies(options->muscle_size_mm, result);
      scale(result, options->scale);
      return result;
    };
    make_files(build, options->folder);
    exit_code = 0;
  });
}

void add_knee(CLI::App& anatomy, int& exit_code) {
  CLI::App* knee = anatomy.add_subcommand(
      "knee", "Right knee in extension: femur, tibia, their cartilage, menisci");
  struct Options {
    KneeResolution resolution;
    KneeShape shape;
    std::filesystem::path folder;
  };
  const auto options = std::make_shared<Options>();
  knee->add_option(
          "--size", options->resolution.size_mm,
          "Element size of cartilage and menisci in mm, along the surfaces (0.4 to 4), and of "
          "ligaments (1.5 to 4)")
      ->capture_default_str();
  knee->add_option("--layers", options->resolution.layers,
                   "Elements through their thickness (2 to 6)")
      ->capture_default_str();
  knee->add_option("--focus", options->resolution.focus,
                   "How many times finer cartilage is where that of a standing knee touches "
                   "(1 to 3)")
      ->capture_default_str();
  knee->add_option("--scale", options->shape.scale,
                   "Factor of all lengths but the thickness of cartilage (0.75 to 1.3)")
      ->capture_default_str();
  knee->add_option("--cartilage", options->shape.cartilage,
                   "Factor of the thickness of cartilage (0.6 to 1.5)")
      ->capture_default_str();
  knee->add_flag("--patella", options->shape.patella,
                 "Adds the patella, the femur with its groove, and the cartilage of both");
  knee->add_flag(
      "--ligaments", options->shape.ligaments,
      "Adds the ACL and the superficial MCL as tissue with fibres, and the bone they touch; with "
      "--patella the patellar tendon too");
  knee->add_option("--out", options->folder, "Folder for the files, made if it is not there")
      ->required()
      ->type_name("DIR");
  knee->callback([options, &exit_code] {
    make_files([&] { return knee_anatomy(options->resolution, options->shape); }, options->folder);
    exit_code = 0;
  });
}

}  // namespace

void add_anatomy_command(CLI::App& app, int& exit_code) {
  CLI::App* anatomy =
      app.add_subcommand("anatomy", "Builds joint geometry from published dimensions");
  anatomy->require_subcommand(1);
  add_mandible(*anatomy, exit_code);
  add_knee(*anatomy, exit_code);
}

}  // namespace articular::anatomy
