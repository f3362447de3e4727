#include "sim/model/displace.hpp"

namespace articular::sim {

void displace(const Model& model, const Eigen::VectorXd& u, Eigen::VectorXd& y) {
  const Layout& layout = model.layout;
  y.head(3 * layout.num_free_nodes) += u.head(3 * layout.num_free_nodes);
  for (int r = 0; r < layout.num_rigid; ++r) {
    const int row = 3 * model.rigid_bodies[static_cast<std::size_t>(r)].block;
    y.segment<3>(layout.rigid_p(r)) += u.segment<3>(row);
    turn(y.data() + layout.rigid_q(r), u.segment<3>(row + 3));
  }
}

}  // namespace articular::sim
