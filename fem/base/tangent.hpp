#pragma once

namespace articular::fem {

/// Which tangent an assembly uses: the consistent one, or each element's projected to be positive
/// semidefinite (for solvers that need it far from equilibrium).
enum class Tangent { Consistent, Projected };

}  // namespace articular::fem
