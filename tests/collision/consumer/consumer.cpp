#include <collision/blocks/block_collide.hpp>
using namespace articular::collision;

int main() {
  const Eigen::Matrix4Xi tets = Eigen::Vector4i(0, 1, 2, 3);
  const Eigen::Matrix3Xd X = Eigen::Matrix<double, 3, 4>{{0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  const Surface surface = build_surface(tets, 4);
  BlockTree a(tets, surface, X), b(tets, surface, X);
  a.update(X);
  b.update(X.array() + 0.2);
  std::vector<Penetration> pairs;
  BlockQueryCounts counts;
  BlockQueryScratch scratch;
  faces_in_body(a, b, pairs, counts, scratch);
  return pairs.size() == 1 && pairs[0].face == 0 ? 0 : 1;
}
