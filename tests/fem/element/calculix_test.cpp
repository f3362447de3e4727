// The same meshes, laws and loads in CalculiX (Debian's calculix-ccx, element C3D4): displacements
// must agree to the digits that its converged solution has. Skipped where the program is missing.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "fem/material/mooney_rivlin.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/calculix_input.hpp"
#include "tests/fem/support/fixed_nodes.hpp"

namespace articular::fem::calculix_test {

constexpr double kE = 250, kNu = 0.4;  // [MPa] with mm and N
constexpr double kAgreement = 1e-5;    // [-] relative

/// A jittered block, clamped at z = 0, pulled and sheared at its top by dead forces.
struct Problem {
  Positions X;
  Tetrahedra tets;
  Positions force;
  std::vector<bool> clamped;
};

Problem block() {
  const TetMesh mesh = box_mesh({3, 3, 4}, {3, 3, 4}, 0.15);
  Problem problem{mesh.X, mesh.tets, Positions::Zero(3, mesh.X.cols()), {}};
  for (Eigen::Index i = 0; i < mesh.X.cols(); ++i) {
    problem.clamped.push_back(mesh.X(2, i) == 0);
    if (mesh.X(2, i) == 4) problem.force.col(i) = Vec3(4, 1.5, 8);
  }
  return problem;
}

/// Newton's iteration from rest.
Positions displacements(const Problem& problem, const AnyMaterial& material) {
  const Elasticity elasticity(problem.X, problem.tets, material);
  BlockMatrix K = elasticity.make_matrix();
  Positions x = problem.X;
  for (int iteration = 0; iteration < 30; ++iteration) {
    Positions f = Positions::Zero(3, x.cols()), step = Positions::Zero(3, x.cols());
    elasticity.add_internal_force(x, f);
    K.set_zero();
    elasticity.add_stiffness(x, Tangent::Consistent, 1, K);
    solve_with_fixed_nodes(K, problem.force - f, problem.clamped, step);
    x += step;
    if (step.norm() < 1e-11) return x - problem.X;
  }
  ADD_FAILURE() << "Newton's iteration did not converge";
  return x - problem.X;
}

class CalculiX : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v ccx > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "CalculiX (ccx) is not installed";
    std::string name = (std::filesystem::temp_directory_path() / "articular-ccx-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  /// @param material  its lines of the input, and that all elements have it
  /// @param step  those of the step
  Positions solution(const Problem& problem, const std::string& material, const std::string& step) {
    std::ofstream in(folder_ / "block.inp");
    write_calculix_mesh(in, problem.X, problem.tets);
    in << material;
    in << "*BOUNDARY\n";
    for (Eigen::Index i = 0; i < problem.X.cols(); ++i)
      if (problem.clamped[static_cast<std::size_t>(i)]) in << i + 1 << ", 1, 3, 0\n";
    in << step << "*CLOAD\n";
    for (Eigen::Index i = 0; i < problem.X.cols(); ++i)
      for (int k = 0; k < 3; ++k)
        if (problem.force(k, i) != 0)
          in << i + 1 << ", " << k + 1 << ", " << problem.force(k, i) << '\n';
    in << "*NODE PRINT, NSET=ALL\nU\n*END STEP\n";
    in.close();
    const std::string command =
        "cd '" + folder_.string() + "' && OMP_NUM_THREADS=1 ccx block > log 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return last_displacements(problem.X.cols());
  }

 private:
  /// Of the last table in block.dat.
  Positions last_displacements(Eigen::Index num_nodes) const {
    Positions u = Positions::Zero(3, num_nodes);
    std::ifstream dat(folder_ / "block.dat");
    Eigen::Index rows = 0;
    for (std::string line; std::getline(dat, line);) {
      std::istringstream numbers(line);
      Eigen::Index node = 0;
      Vec3 value;
      if (numbers >> node >> value.x() >> value.y() >> value.z()) {
        u.col(node - 1) = value;
        ++rows;
      }
    }
    EXPECT_GE(rows, num_nodes);
    return u;
  }

  std::filesystem::path folder_;
};

double difference(const Positions& a, const Positions& b) { return (a - b).norm() / b.norm(); }

TEST_F(CalculiX, AgreesOnHookesLaw) {
  const Problem problem = block();
  std::ostringstream material;
  material << "*MATERIAL, NAME=TISSUE\n*ELASTIC\n"
           << kE << ", " << kNu << "\n*SOLID SECTION, ELSET=BLOCK, MATERIAL=TISSUE\n";
  const Positions theirs = solution(problem, material.str(), "*STEP\n*STATIC\n");
  EXPECT_LT(difference(displacements(problem, Linear(kE, kNu)), theirs), kAgreement);
}

TEST_F(CalculiX, AgreesOnTheIsochoricNeoHookeanLawAtFiniteStrain) {
  const Problem problem = block();
  const auto [mu, lambda] = lame_parameters(kE, kNu);
  std::ostringstream material;
  write_calculix_neo_hooke(material, mu, lambda + 2 * mu / 3);
  const Positions theirs = solution(
      problem, material.str(),
      "*STEP, NLGEOM, INC=1000\n*CONTROLS, PARAMETERS=FIELD\n1e-9, 1e-9\n*STATIC\n0.25, 1\n");
  const Positions ours =
      displacements(problem, MooneyRivlin<VolumeChange>(mu / 2, 0, lambda + 2 * mu / 3));
  EXPECT_GT(ours.row(2).maxCoeff(), 0.4);  // a strain that Hooke's law would not do for
  EXPECT_LT(difference(ours, theirs), kAgreement);
}

}  // namespace articular::fem::calculix_test
