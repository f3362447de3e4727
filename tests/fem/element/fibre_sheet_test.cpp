#include "fem/element/fibre_sheet.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem::fibre_sheet_test {

const Vec3 kSize(0.04, 0.02, 0.01);  // [m]
constexpr double kThickness = 0.4e-3;
constexpr CrimpedFibre kLaw{.stiffness = 3e8, .toe_strain = 0.02};

/// The faces of a box whose nodes all lie at z = 0, seen from below.
Triangles lower_faces(const TetMesh& mesh) {
  Triangles faces(3, 0);
  for (const auto& tet : mesh.tets.colwise()) {
    static constexpr int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    for (const auto& corner : kFaces) {
      const Eigen::Vector3i face(tet[corner[0]], tet[corner[1]], tet[corner[2]]);
      if (!(mesh.X(2, face).array().abs() < 1e-9).all()) continue;
      faces.conservativeResize(3, faces.cols() + 1);
      faces.rightCols<1>() = face;
    }
  }
  return faces;
}

/// A block with a sheet under it. @param fibre  part of it may be across the sheet
struct Block {
  TetMesh mesh = box_mesh({4, 3, 2}, kSize, 0.15);
  Triangles faces = lower_faces(mesh);
  BlockMatrix matrix;
  FibreSheet sheet;

  explicit Block(const Vec3& fibre)
      : matrix(Elasticity(mesh.X, mesh.tets, Linear(1e4, 0.3)).make_matrix()),
        sheet(mesh.X, faces, fibre.replicate(1, faces.cols()), kThickness, kLaw, matrix) {}

  Positions force(const Positions& x) const {
    Positions f = Positions::Zero(3, x.cols());
    sheet.add_force(x, f);
    return f;
  }
};

/// Blankevoort's curve of the nominal stress, in the straight part.
double straight_stress(double strain) { return 3e8 * (strain - 0.02); }

// Σ f Xᵀ = ∫ P dV: all of the sheet has the nominal stress σ along n = F d/|F d| of a cut across d.
TEST(FibreSheet, OfAHomogeneousStretchHasOneStressAlongItsFibres) {
  const Vec3 given(2, 1, 0.7), along = Vec3(2, 1, 0).normalized();
  const Block block(given);
  const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  Mat3 stretch = Vec3(1.11, 1.05, 0.8).asDiagonal();
  stretch(0, 1) = 0.06;
  const Positions x = (turn * stretch * block.mesh.X).colwise() + Vec3(0.3, -1, 2);
  const Vec3 fibre = turn * stretch * along;
  const double strain = fibre.norm() - 1, volume = kThickness * kSize.x() * kSize.y();
  ASSERT_GT(strain, 0.04);
  const Mat3 expected = volume * straight_stress(strain) * fibre.normalized() * along.transpose();
  const Mat3 found = block.force(x) * block.mesh.X.transpose();
  EXPECT_LT((found - expected).norm(), 1e-10 * expected.norm());
  EXPECT_LT((block.sheet.stretch(x).array() - 1 - strain).abs().maxCoeff(), 1e-12);
  EXPECT_LT((block.sheet.tension(x).array() / (kThickness * straight_stress(strain)) - 1)
                .abs()
                .maxCoeff(),
            1e-10);
  EXPECT_NEAR(block.sheet.area().sum(), kSize.x() * kSize.y(), 1e-15);
  // Up to the end of the toe, at a strain of 0.04, E e³/(12 e_l); then a straight line.
  const double toe = 3e8 * 0.04 * 0.04 * 0.04 / (12 * 0.02), beyond = strain - 0.04;
  const double energy = volume * (toe + beyond * 0.5 * (3e8 * 0.02 + straight_stress(strain)));
  EXPECT_NEAR(block.sheet.energy(x), energy, 1e-10 * energy);
}

TEST(FibreSheet, ResistsNeitherPressureNorWhatIsAcross) {
  const Block block(Vec3::UnitX());
  for (const Vec3& stretch : {Vec3(0.8, 1, 1), Vec3(1 - 1e-9, 1.4, 0.7), Vec3(0.999, 0.5, 2)}) {
    const Positions x = stretch.asDiagonal() * block.mesh.X;
    EXPECT_EQ(block.force(x), Positions::Zero(3, x.cols()));
    EXPECT_EQ(block.sheet.energy(x), 0);
    EXPECT_EQ(block.sheet.tension(x).maxCoeff(), 0);
  }
}

/// Some faces slack, some in the toe, some straight.
struct Moved {
  Block block{Vec3(1, 2, 0.3)};
  Random random;
  Positions x = Vec3(1.03, 1.02, 1).asDiagonal() * block.mesh.X +
                4e-4 * random.matrix<Positions>(3, block.mesh.X.cols()),
            u = random.matrix<Positions>(3, block.mesh.X.cols());

  Moved() {
    const Eigen::VectorXd stretch = block.sheet.stretch(x);
    EXPECT_LT(stretch.minCoeff(), 1);
    EXPECT_GT(stretch.maxCoeff(), 1.04);
  }
};

// By central differences: their error is of the square of the step, and of the step at a kink.
TEST(FibreSheet, ForceIsTheSlopeOfTheEnergyAndStiffnessThatOfTheForce) {
  constexpr double kStep = 1e-8, kScale = 3;
  Moved m;
  const Positions up = m.x + kStep * m.u, down = m.x - kStep * m.u;
  const double power = (m.block.sheet.energy(up) - m.block.sheet.energy(down)) / (2 * kStep);
  EXPECT_NEAR(m.block.force(m.x).cwiseProduct(m.u).sum(), power, 1e-6 * std::abs(power));
  const Positions slope = (m.block.force(up) - m.block.force(down)) / (2 * kStep);
  m.block.matrix.set_zero();
  m.block.sheet.add_stiffness(m.x, kScale, m.block.matrix);
  const Eigen::VectorXd product = dense(m.block.matrix) * m.u.reshaped();
  EXPECT_LT((product - kScale * slope.reshaped()).norm(), 1e-5 * product.norm());
}

TEST(FibreSheet, StiffnessIsSymmetricAndPositiveSemidefinite) {
  Moved m;
  m.block.matrix.set_zero();
  m.block.sheet.add_stiffness(m.x, 1, m.block.matrix);
  const Eigen::MatrixXd K = dense(m.block.matrix);
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
  EXPECT_LT((K - K.transpose()).norm(), 1e-14 * K.norm());
  EXPECT_GT(values.minCoeff(), -1e-12 * values.maxCoeff());
}

TEST(FibreSheet, RefusesWhatFibresCannotLieIn) {
  const auto message_of = [](const Vec3& fibre, const Positions& X) {
    const Block block(Vec3::UnitX());
    try {
      const FibreSheet sheet(X, block.faces, fibre.replicate(1, block.faces.cols()), kThickness,
                             kLaw, block.matrix);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const TetMesh mesh = Block(Vec3::UnitX()).mesh;
  EXPECT_NE(message_of({0.01, 0, 1}, mesh.X).find(" 0) mm is crossed by the fibres"),
            std::string::npos);
  EXPECT_EQ(message_of({1, 0, 1}, mesh.X), "");
  EXPECT_NE(
      message_of(Vec3::UnitX(), Vec3(0, 1, 1).asDiagonal() * mesh.X).find(" 0) mm has no area"),
      std::string::npos);
}

}  // namespace articular::fem::fibre_sheet_test
