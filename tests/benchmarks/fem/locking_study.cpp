// tests/benchmarks/locking_study [accuracy | meshes | newton | modes | fibres | cost]...
//
// Which linear tetrahedron neither locks nor softens: the tables of fem/RESULTS.md, in markdown.
// Without arguments all but fibres (a few minutes; fibres alone five). Problems:
// tests/fem/support/loaded_body.hpp.
//
//     Cook's membrane        block under local pressure        slender beam, bent by 6/10 of its
//     length
//          __--|^                  vvvv                        |=============
//      _--     |^                 +----+--+                    |             ^
//     |      __|^                 |       |
//     |  __--                     +-------+
//
// Converged results of Cook's membrane and of the block: quadratic tetrahedra and three-field
// hexahedra (FEBio 4.11). That of the beam: see bent_beam_result().

#include "tests/benchmarks/fem/locking_study.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <stdexcept>

#include "fem/material/any_material.hpp"
#include "tests/fem/support/delaunay_mesh.hpp"

namespace articular::fem {
namespace {

using Domains = DomainElasticity::Domains;

const std::map<double, double> kCook{{0.3, 8.756}, {0.49, 7.015}, {0.499, 6.921}, {0.4999, 6.911}};
const std::map<double, double> kBlock{{0.49, -0.276}, {0.499, -0.274}};

// The beam: E = 1000, ν = 0.3, length 10, section 1 x 1 (EI = 83.3), force 2.5, so that F L²/EI
// = 3. Euler's elastica, without extension and shear, is deflected by 0.6033 L there [Bisshopp
// 1945]. This beam shears and extends: 6.074 by Richardson's extrapolation of ES .95 + PP 1.5 from
// above (6.1968, 6.1266, 6.0967 with 960, 7,680, 61,440 tetrahedra), 6.095 of plain + PP 1 from
// below (5.3416, 5.8660, 6.0253).
//
// [Bisshopp 1945] Bisshopp, Drucker. Large deflection of cantilever beams. Q. Appl. Math. 3:272.
constexpr double kBeamForce = 2.5, kBeamModulus = 1000, kBeamNu = 0.3;
constexpr double kBeam = 6.08;  // ± 0.01

constexpr int kLoadSteps = 20;

std::string percent(double value, double expected) {
  if (!std::isfinite(value)) return "–";
  char text[32];
  std::snprintf(text, sizeof text, "%+.1f", 100 * (value / expected - 1));
  return text;
}

std::string error(const Candidate& c, const LoadedBody& loaded, double nu, double expected) {
  const Body body(c, loaded.mesh, study_material(nu));
  return percent(equilibrium_of(body, loaded).displacement, expected);
}

double beam_result(const Candidate& c, int n, MeshKind kind = MeshKind::Kuhn) {
  const LoadedBody loaded = bent_beam(n, kBeamForce, kind);
  const Body body(c, loaded.mesh, study_material(kBeamNu, kBeamModulus / (2 * (1 + kBeamNu))));
  return equilibrium_of(body, loaded).displacement;
}

void print_delaunay(const char* name, const LoadedBody& loaded) {
  const MeshQuality quality = quality_of(loaded.mesh);
  std::printf("Delaunay, %s: %d nodes, %d tetrahedra, dihedral angles %.1f to %.1f degrees\n", name,
              static_cast<int>(loaded.mesh.X.cols()), static_cast<int>(loaded.mesh.tets.cols()),
              quality.smallest_dihedral, quality.largest_dihedral);
}

}  // namespace

MooneyRivlin<> study_material(double nu, double mu) {
  return {mu / 2, 0, 2 * mu * (1 + nu) / (3 * (1 - 2 * nu))};
}

std::vector<Candidate> candidates() {
  const auto smoothed = [](const char* name, double share, double tau) {
    return Candidate{.name = name, .smoothed = true, .smoothing = {share, tau}};
  };
  return {{.name = "plain", .smoothed = false, .domains = Domains::Elements},
          {.name = "NS", .smoothed = false, .domains = Domains::Nodes},
          {.name = "ES", .smoothed = false, .domains = Domains::Edges},
          smoothed("plain + PP 1", 1, 1),
          smoothed("ES + PP 0.5", 0, 0.5),
          smoothed("ES + PP 1", 0, 1),
          smoothed("ES + PP 2", 0, 2),
          smoothed("ES .95 + PP 1", 0.05, 1),
          smoothed("ES .95 + PP 1.5", 0.05, 1.5),
          smoothed("ES .9 + PP 2", 0.1, 2)};
}

const Candidate& candidate(const std::string& name) {
  static const std::vector<Candidate> all = candidates();
  for (const Candidate& c : all) {
    if (c.name == name) return c;
  }
  throw std::logic_error("no formulation " + name);
}

Body::Body(const Candidate& c, const TetMesh& mesh, const MooneyRivlin<>& material) {
  if (c.smoothed) {
    smoothed_ = std::make_unique<SmoothedElasticity>(mesh.X, mesh.tets, material, c.smoothing);
  } else {
    domains_ = std::make_unique<DomainElasticity>(mesh, c.domains, material);
  }
}

Formulation Body::formulation() const {
  return smoothed_ ? formulation_of(*smoothed_) : domains_->formulation();
}

double Body::pressure_roughness(const Positions& x) const {
  if (!smoothed_) return roughness(domains_->pressure(x), domains_->neighbours());
  Eigen::VectorXd p;
  smoothed_->pressure(x, p);
  return roughness(p, node_neighbours(smoothed_->make_plain_matrix()));
}

Equilibrium equilibrium_of(const Body& body, const LoadedBody& loaded,
                           const NewtonSettings& settings) {
  const Formulation formulation = body.formulation();
  const auto solver =
      formulation.smoothed != nullptr ? make_saddle_point_solver(1e-8, 1000) : make_cholesky();
  Equilibrium result{.x = loaded.mesh.X, .displacement = 0, .report = {}};
  result.report = equilibrate(formulation, loaded, *solver, result.x, settings);
  if (!result.report.converged) {  // in small steps what does not converge in one
    result.x = loaded.mesh.X;
    LoadedBody part = loaded;
    for (int step = 1; step <= kLoadSteps; ++step) {
      part.f_ext = static_cast<double>(step) / kLoadSteps * loaded.f_ext;
      result.report = equilibrate(formulation, part, *solver, result.x, settings);
    }
  }
  result.displacement = result.report.converged ? result.x(loaded.axis, loaded.probe) -
                                                      loaded.mesh.X(loaded.axis, loaded.probe)
                                                : std::numeric_limits<double>::quiet_NaN();
  return result;
}

void print_accuracy() {
  std::printf(
      "\n## Error [%%] (negative: too stiff)\n\n"
      "| distortion + volume | Cook 16: .3 | .49 | .499 | .4999 | Cook 8: .3 | .49 | .499 "
      "| .4999 | block 8: .49 | .499 | block 4: .49 | .499 | beam 960 | 7,680 "
      "| roughness of p: Cook 16 | block 8 |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Candidate& c : candidates()) {
    std::printf("| %s", c.name.c_str());
    for (const int n : {16, 8}) {
      for (const auto& [nu, expected] : kCook) {
        std::printf(" | %s", error(c, cook_membrane(n), nu, expected).c_str());
      }
    }
    for (const int n : {8, 4}) {
      for (const auto& [nu, expected] : kBlock) {
        std::printf(" | %s", error(c, block_compression(n), nu, expected).c_str());
      }
    }
    for (const int n : {1, 2}) std::printf(" | %s", percent(beam_result(c, n), kBeam).c_str());
    for (const LoadedBody& loaded : {cook_membrane(16), block_compression(8)}) {
      const Body body(c, loaded.mesh, study_material(0.499));
      const Equilibrium equilibrium = equilibrium_of(body, loaded);
      std::printf(" | %.2f", equilibrium.report.converged
                                 ? body.pressure_roughness(equilibrium.x)
                                 : std::numeric_limits<double>::quiet_NaN());
    }
    std::printf(" |\n");
    std::fflush(stdout);
  }
}

void print_meshes() {
  std::printf(
      "\n## Error [%%] on other meshes\n\n"
      "| distortion + volume | block 8, moved nodes: .49 | .499 | block 8, five tetrahedra, "
      "moved nodes: .49 | .499 | Cook 16, five, moved: .3 | .499 | beam, moved | beam, five, "
      "moved | block 8, Delaunay: .49 | .499 | Cook 16, Delaunay: .3 | .499 |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  const LoadedBody delaunay_block = delaunay_block_compression(8);
  const LoadedBody delaunay_cook = delaunay_cook_membrane(16);
  for (const char* name :
       {"plain", "NS", "ES + PP 1", "ES .95 + PP 1", "ES .95 + PP 1.5", "ES .9 + PP 2"}) {
    const Candidate& c = candidate(name);
    std::printf("| %s", name);
    for (const MeshKind kind : {MeshKind::MovedNodes, MeshKind::FiveTetrahedra}) {
      for (const auto& [nu, expected] : kBlock) {
        std::printf(" | %s", error(c, block_compression(8, kind), nu, expected).c_str());
      }
    }
    for (const double nu : {0.3, 0.499}) {
      const LoadedBody loaded = cook_membrane(16, MeshKind::FiveTetrahedra);
      std::printf(" | %s", error(c, loaded, nu, kCook.at(nu)).c_str());
    }
    for (const MeshKind kind : {MeshKind::MovedNodes, MeshKind::FiveTetrahedra}) {
      std::printf(" | %s", percent(beam_result(c, 1, kind), kBeam).c_str());
    }
    for (const auto& [nu, expected] : kBlock) {
      std::printf(" | %s", error(c, delaunay_block, nu, expected).c_str());
    }
    for (const double nu : {0.3, 0.499}) {
      std::printf(" | %s", error(c, delaunay_cook, nu, kCook.at(nu)).c_str());
    }
    std::printf(" |\n");
    std::fflush(stdout);
  }
  print_delaunay("block", delaunay_block);
  print_delaunay("Cook", delaunay_cook);
}

void print_curves() {
  std::printf("formulation,nu,cook_16_percent,block_8_percent\n");
  for (const char* name : {"plain", "NS", "ES", "plain + PP 1", "ES .9 + PP 2"}) {
    for (const auto& [nu, expected] : kCook) {
      const std::string cook = error(candidate(name), cook_membrane(16), nu, expected);
      const std::string block =
          kBlock.count(nu) == 0 ? ""
                                : error(candidate(name), block_compression(8), nu, kBlock.at(nu));
      std::printf("%s,%g,%s,%s\n", name, nu, cook.c_str(), block.c_str());
    }
  }
}

void print_newton() {
  std::printf(
      "\n## Newton iterations, whole load in one step, Cook 16, ES .9 + PP 2\n\n"
      "| ν | p an unknown | p = A⁻¹ b(x) | result |\n|---|---|---|---|\n");
  const LoadedBody loaded = cook_membrane(16);
  for (const double nu : {0.3, 0.49, 0.499, 0.4999, 0.49999, 0.499999}) {
    const Body body(candidate("ES .9 + PP 2"), loaded.mesh, study_material(nu));
    const Equilibrium mixed = equilibrium_of(body, loaded);
    const Equilibrium alone = equilibrium_of(
        body, loaded, {.tolerance = 1e-7, .max_iterations = 200, .pressure_unknown = false});
    std::printf("| %g | %d | %d | %.4f |\n", nu, mixed.report.iterations, alone.report.iterations,
                mixed.displacement);
  }
}

}  // namespace articular::fem

int main(int argc, char** argv) {
  using namespace articular::fem;
  const std::map<std::string, void (*)()> parts{
      {"accuracy", print_accuracy}, {"meshes", print_meshes}, {"newton", print_newton},
      {"modes", print_modes},       {"cost", print_cost},     {"curves", print_curves},
      {"fibres", print_fibres}};
  std::vector<std::string> chosen(argv + 1, argv + argc);
  if (chosen.empty()) chosen = {"accuracy", "meshes", "newton", "modes", "cost"};
  for (const std::string& name : chosen) {
    if (parts.count(name) == 0) {
      std::fprintf(stderr,
                   "locking_study: no part `%s`; there are accuracy, meshes, newton, modes, "
                   "fibres, cost, curves\n",
                   name.c_str());
      return EXIT_FAILURE;
    }
    parts.at(name)();
  }
}
