#include "sim/build/memory_need.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include "sim/base/available_memory.hpp"
#include "sim/build/build_model.hpp"
#include "sim/mesh/shapes.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::memory_need_test {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A cube of tissue of n cells an edge.
Scenario cube(int n, TissueMaterial::Element element) {
  Scenario s = scene(1e-3);
  Body body = box_body("cube", Body::Kind::Tissue, {0.02, 0.02, 0.02});
  std::get<BoxGeometry>(body.geometry).cells = Eigen::Vector3i::Constant(n);
  body.material->element = element;
  s.bodies = {body};
  return s;
}

std::string refusal(const Scenario& s, double available) {
  try {
    refuse_more_memory(s, {num_shape_tetrahedra(s.bodies[0])}, available);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MemoryNeed, TetrahedraOfAShapeAreCountedBeforeItIsMade) {
  Body body;
  const BoxGeometry box{{1, 2, 3}, {3, 4, 5}, Vec3::Zero()};
  body.geometry = box;
  EXPECT_EQ(num_shape_tetrahedra(body), static_cast<double>(box_mesh(box).tets.cols()));
  const VShapeGeometry v{1, 0.2, 1, {5, 3}};
  body.geometry = v;
  EXPECT_EQ(num_shape_tetrahedra(body), static_cast<double>(v_shape_mesh(v).tets.cols()));
  for (const double size : {0.07, 0.3, 0.9}) {
    const SphereGeometry sphere{1, size, {}};
    body.geometry = sphere;
    EXPECT_EQ(num_shape_tetrahedra(body), static_cast<double>(sphere_mesh(sphere).tets.cols()));
  }
  body.geometry = std::monostate{};
  EXPECT_EQ(num_shape_tetrahedra(body), 0);
}

// What is refused can't be built, and a scene is not refused that needs a half of it.
TEST(MemoryNeed, IsNoMoreThanAModelTakesAndNoLessThanHalf) {
  for (const auto element : {TissueMaterial::Element::Plain, TissueMaterial::Element::Smoothed}) {
    const Scenario s = cube(16, element);
    const auto in_use = [] {
      const struct mallinfo2 info = mallinfo2();
      return static_cast<double>(info.uordblks + info.hblkhd);
    };
    const double before = in_use();
    const Model model = build_model(s);
    const double taken = in_use() - before;
    if (taken == 0) GTEST_SKIP() << "a sanitizer's allocator does not tell how much is in use";
    const double need = memory_need(s, {num_shape_tetrahedra(s.bodies[0])}).model;
    EXPECT_LT(need, 1.1 * taken);
    EXPECT_GT(need, 0.5 * taken);
  }
}

TEST(MemoryNeed, OfMoreThanThereIsIsRefusedWithBothFigures) {
  const Scenario s = cube(200, TissueMaterial::Element::Smoothed);
  const std::string words = refusal(s, 20e9);
  for (const char* const part :
       {"at least 197 GB", "20 GB are available", "`cube` alone has 4.8e+07 tetrahedra", "plain"})
    EXPECT_NE(words.find(part), std::string::npos) << words;
  EXPECT_EQ(refusal(s, 200e9), "");
  EXPECT_NE(refusal(cube(1000, TissueMaterial::Element::Plain), kInfinite).find("at most 5.37e+08"),
            std::string::npos);
}

TEST(MemoryNeed, OfMatricesIsNoneWithoutThem) {
  Scenario s = cube(2, TissueMaterial::Element::Plain);
  EXPECT_GT(memory_need(s, {48}).matrices, 0);
  s.integrator.scheme = Integrator::Scheme::Explicit;
  EXPECT_EQ(memory_need(s, {48}).matrices, 0);
  s.analysis = Scenario::Analysis::Static;
  EXPECT_GT(memory_need(s, {48}).matrices, 0);
}

TEST(AvailableMemory, IsSomeOfTheMachines) {
  EXPECT_GT(available_memory(), 1e7);
  EXPECT_EQ(size_text(2.14e9), "2.14 GB");
  EXPECT_EQ(size_text(999), "0.999 kB");
}

}  // namespace articular::sim::memory_need_test
