#pragma once

#include "sim/model/model.hpp"

namespace articular::sim {

/// Corrects what a step of implicit Euler left, so that free rigid bodies follow L̇ = τ,
///
///   L₁ = L₀ + h τ₁,   ω₁ ← I₁⁻¹ L₁,   h τ₁ = I₁ (ω₁ − ω₀) + h ω₁ × I₁ ω₁,
///
/// instead of I ω̇ = τ − ω × I ω: then a body on which nothing acts keeps its angular momentum as
/// well as Newton's iteration converges, and its energy can but fall, as (Π₀ − Π₁)ᵀ I⁻¹ (Π₀ − Π₁)/2
/// a step, Π = Rᵀ L. Without it a tumbling body spins up. Changes ω by O(h²). Held rigid bodies are
/// left as they are: what holds them takes their momentum.
void keep_angular_momentum(const Model& model, const Eigen::VectorXd& before, double h,
                           Eigen::VectorXd& after);

}  // namespace articular::sim
