#pragma once

namespace articular::fem {

/// Which tangent an assembly uses: the consistent one, or each element's projected to be positive
/// semidefinite (for solvers that need it far from equilibrium).
enum class Tangent { Consistent, Projected };

/// A tangent whose lowest eigenvalue lies above minus this part of its norm is positive
/// semidefinite up to round-off: rigid rotations put zeros there.
inline constexpr double kRoundOffOfProjection = 1e-13;  // [-]

}  // namespace articular::fem
