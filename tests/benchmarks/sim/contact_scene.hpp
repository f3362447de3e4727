#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/mesh/shapes.hpp"
#include "sim/step/stepper.hpp"
#include "tests/sim/support/temporary_folder.hpp"

/// Scenes of tissue blocks and rigid indenters, and what is measured in them.
namespace articular::sim {

/// How depths count: as averages at nodes, which is what statics does, or point by point.
enum class DepthRule { Averaged, Pointwise };
/// As the command line names them, in this order.
inline constexpr const char* kDepthRules[] = {"averaged", "pointwise"};

/// What every contact study takes from the command line.
struct StudyOptions {
  double stiffness = 1;  // factor on the contact stiffness that the model chooses
  DepthRule rule = DepthRule::Averaged;
  TissueMaterial::Element element = TissueMaterial::Element::Smoothed;
  int finest = 16;  // studies that refine stop at this many elements over their length
};

/// Where the planes of a grid of cells stand [m], increasing.
struct GridLines {
  std::vector<double> x, y, z;
};
std::vector<double> uniform_lines(double from, double to, int cells);
/// From -half to half: cells of size h up to `fine` on both sides, beyond it each larger than the
/// last by the factor `growth`. All in metres.
std::vector<double> graded_lines(double half, double fine, double h, double growth);
/// From `bottom` to 0, cells of size h at 0 (see graded_lines()).
std::vector<double> graded_depth(double bottom, double fine, double h, double growth);

/// Six tetrahedra a cell, mirrored from cell to cell.
MeshData block_mesh(const GridLines& lines);
/// Moves the nodes of a block by up to `part` of a cell of size h [m] along each axis; nodes of a
/// face or an edge stay in it.
void jitter(MeshData& mesh, double h, double part, unsigned seed);
/// The lower cap of a sphere that touches the origin from above, over a square of half width
/// `half`, with facets of size h up to `fine`. Triangles only. All in metres.
MeshData sphere_cap(double radius, double half, double fine, double h);

/// A scenario whose meshes are made in code. It reads them from a folder that lives as long.
class Scene {
 public:
  explicit Scene(const StudyOptions& options);

  void tissue(const std::string& name, const MeshData& mesh, const fem::AnyMaterial& law);
  void add_rigid(const std::string& name, const MeshData& mesh);
  void add(Body body) { scenario_.bodies.push_back(std::move(body)); }
  /// Nodes of a tissue between two heights [m] move with a fixed body.
  void tie(const std::string& tissue, const std::string& rigid, double z_low, double z_high);
  /// Those between two corners [m].
  void tie_box(const std::string& tissue, const std::string& rigid, const Vec3& low,
               const Vec3& high);
  /// A fixed body goes along straight lines from one place to the next, one a unit of time.
  void drive(const std::string& rigid, const std::vector<Vec3>& places);
  /// The one pair that touches.
  void touch(const std::string& a, const std::string& b);

  const Scenario& scenario() const { return scenario_; }

 private:
  Body meshed(const std::string& name, const MeshData& mesh);

  TemporaryFolder folder_;
  Scenario scenario_;
  TissueMaterial::Element element_;
};

/// What the pair of a scene carries.
struct ContactValues {
  Vec3 force = Vec3::Zero();  // on the body named first [N]
  double area = 0;            // [m²]
  double penetration = 0;     // [m] largest
};

/// Contact force at a node of the surface that is pressed.
struct NodalContact {
  Vec3 X;           // at the start [m]
  double force;     // [N]
  double pressure;  // [Pa] by the area around the node at the start
};

/// Work per step since the last reset_costs().
struct Costs {
  double iterations = 0;  // of Newton
  int rejected = 0;       // solutions that did not converge, in all
  double seconds = 0;     // wall time
};

class ContactRun {
 public:
  ContactRun(const Scene& scene, const StudyOptions& options);

  /// One load step to the time `t`, halved where it does not converge.
  void step(double t);
  void steps(double until, int count);
  void reset_costs();
  Costs costs() const;

  ContactValues contact() const;
  /// Of the surface of a body whose outward normal at the start is within 60 degrees of `outward`.
  std::vector<NodalContact> nodal_contacts(const std::string& body, const Vec3& outward) const;
  /// Cauchy's stress σ_zz of every element of a tissue [Pa].
  Eigen::VectorXd axial_stress(std::size_t tissue) const;
  const Model& model() const { return model_; }
  const ContactResponse& response() const { return stepper_.now().contact; }
  const Configuration& configuration() const { return stepper_.now().configuration; }

 private:
  const Model model_;
  Stepper stepper_;
  State state_;
  int steps_ = 0;
  double seconds_ = 0;
  SolverCounts before_;
};

/// The largest pressure at a node [Pa].
double peak_pressure(const std::vector<NodalContact>& nodes);

/// The columns that every table ends with.
extern const char* const kCostHeader;
extern const char* const kCostRule;
std::string cost_columns(const Costs& costs);
/// A row that could not be computed: its name and why.
void print_failure(const std::string& name, const std::exception& error);

}  // namespace articular::sim
