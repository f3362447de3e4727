#include "sim/model/layer_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace articular::sim::layer_law_test {

constexpr LogarithmicLayer kLigament{4.5e6, 0.4e-3}, kOther{1.3e6, 0.7e-3};
constexpr double kSoft = 2e-10;  // [m/Pa] beside them; kLigament has 9e-11 at no depth

double thickness(const LayersInSeries& layers) {
  return layers.layer[0].thickness + layers.layer[1].thickness;
}

std::vector<LayersInSeries> examples() {
  return {{0, {kLigament, {}}},
          {0, {LogarithmicLayer{}, kOther}},
          {0, {kLigament, kOther}},
          {kSoft, {kLigament, {}}},
          {kSoft, {kLigament, kOther}}};
}

// p = −M ln(1 − u) and ∫ p dd = M t ((1 − u) ln(1 − u) + u), with u = d/t.
TEST(LayerLaw, OfOneLayerIsTheLogarithmOfWhatIsLeftOfIt) {
  const auto& [M, t] = kLigament;
  for (const double u : {0.01, 0.1, 0.5, 0.8, 0.899}) {
    const PressedLayers now = pressed({0, {kLigament, {}}}, u * t);
    EXPECT_NEAR(now.pressure / (-M * std::log(1 - u)), 1, 1e-12) << u;
    EXPECT_NEAR(now.slope / (M / (t * (1 - u))), 1, 1e-12) << u;
    EXPECT_NEAR(now.energy / (M * t * ((1 - u) * std::log(1 - u) + u)), 1, 1e-11) << u;
  }
}

TEST(LayerLaw, BeginsAsALinearOneAndPullsAsOneWhereSurfacesAreApart) {
  for (const LayersInSeries& layers : examples()) {
    const double k =
        1 / (layers.linear + layers.layer[0].compliance() + layers.layer[1].compliance());
    const double shallow = 1e-9 * thickness(layers);
    const PressedLayers now = pressed(layers, shallow), apart = pressed(layers, -shallow);
    EXPECT_NEAR(now.pressure / (k * shallow), 1, 1e-8);
    EXPECT_NEAR(now.energy / (0.5 * k * shallow * shallow), 1, 1e-8);
    EXPECT_NEAR(now.slope / k, 1, 1e-8);
    EXPECT_NEAR(apart.pressure / (-k * shallow), 1, 1e-12);
    EXPECT_NEAR(apart.slope / k, 1, 1e-12);
    EXPECT_EQ(apart.energy, 0);
  }
}

// Also across 0.9 of a thickness, where a layer goes on by its tangent.
TEST(LayerLaw, PressureIsTheDerivativeOfTheEnergyAndTheSlopeThatOfThePressure) {
  for (const LayersInSeries& layers : examples()) {
    const double size = thickness(layers), h = 1e-6 * size;
    for (double depth = 1e-3 * size; depth < 4 * size; depth *= 1.3) {
      const PressedLayers less = pressed(layers, depth - h), now = pressed(layers, depth),
                          more = pressed(layers, depth + h);
      EXPECT_NEAR((more.energy - less.energy) / (2 * h * now.pressure), 1, 1e-6) << depth / size;
      EXPECT_NEAR((more.pressure - less.pressure) / (2 * h * now.slope), 1, 1e-6) << depth / size;
    }
  }
}

// Up to 0.9 of each.
TEST(LayerLaw, DepthsOfLayersInSeriesAddUp) {
  for (const double pressure : {1e2, 1e5, 1e6, 2.9e6}) {
    double depth = kSoft * pressure;
    for (const auto& [M, t] : {kLigament, kOther}) depth += t * (1 - std::exp(-pressure / M));
    EXPECT_NEAR(pressed({kSoft, {kLigament, kOther}}, depth).pressure / pressure, 1, 1e-12);
  }
}

TEST(LayerLaw, TwoAlikeAreAsOneOfTwiceTheThickness) {
  const LogarithmicLayer twice{kLigament.modulus, 2 * kLigament.thickness};
  for (const double u : {1e-6, 0.3, 0.89, 0.95, 3.0}) {
    const double depth = u * twice.thickness;
    const PressedLayers two = pressed({kSoft, {kLigament, kLigament}}, depth),
                        one = pressed({kSoft, {twice, {}}}, depth);
    EXPECT_NEAR(two.pressure / one.pressure, 1, 1e-12) << u;
    EXPECT_NEAR(two.energy / one.energy, 1, 1e-12) << u;
    EXPECT_NEAR(two.slope / one.slope, 1, 1e-12) << u;
  }
}

// A hundred times the thickness: what an iteration may try.
TEST(LayerLaw, BeyondNineTenthsGoesOnByItsTangent) {
  const auto& [M, t] = kLigament;
  for (const double u : {0.95, 2.0, 100.0}) {
    const PressedLayers now = pressed({0, {kLigament, {}}}, u * t);
    EXPECT_NEAR(now.slope / (10 * M / t), 1, 1e-12) << u;
    const double beyond = u - 0.9, first = std::log(10);
    EXPECT_NEAR(now.pressure / (M * (first + 10 * beyond)), 1, 1e-12) << u;
    const double energy = 0.9 - 0.1 * first + first * beyond + 5 * beyond * beyond;
    EXPECT_NEAR(now.energy / (M * t * energy), 1, 1e-12) << u;
  }
}

}  // namespace articular::sim::layer_law_test
