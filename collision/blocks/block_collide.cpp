#include "collision/blocks/block_collide.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>
#include <utility>

#include "collision/blocks/box_group.hpp"
#include "collision/mesh/bad_input.hpp"
#include "collision/narrow/narrow_rule.hpp"

namespace articular::collision {
namespace {

/// Face blocks that are tested against a block of tetrahedra in one go: bounds the lists of pairs.
constexpr std::size_t kMostFaceBlocks = 128;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Boxes with the number of what is in them, in groups for the vectorised test.
struct BoxList {
  std::vector<BoxGroup> groups;
  std::vector<int> ids;

  void clear() {
    groups.clear();
    ids.clear();
  }
  void push(const FloatBox& box, int id) {
    const std::size_t lane = ids.size() % kLanes;
    if (lane == 0) groups.push_back(empty_group());
    put(box, groups.back(), lane);
    ids.push_back(id);
  }
};

/// From one tree's frame into another's. The result is not rounded outward: boxes have room for it.
struct FrameChange {
  double factor;
  Eigen::Vector3d shift;

  FrameChange(const BlockTree& from, const BlockTree& to)
      : factor(from.scale() / to.scale()), shift((from.origin() - to.origin()) / to.scale()) {}
  FloatBox operator()(const FloatBox& box) const {
    FloatBox moved;
    for (int axis = 0; axis < 3; ++axis) {
      moved.low[axis] = static_cast<float>(box.low[axis] * factor + shift[axis]);
      moved.high[axis] = static_cast<float>(box.high[axis] * factor + shift[axis]);
    }
    return moved;
  }
};

template <class Visit>
void for_each_bit(unsigned mask, Visit&& visit) {
  for (; mask != 0; mask &= mask - 1) visit(static_cast<std::size_t>(__builtin_ctz(mask)));
}

/// Sixteen blocks of tetrahedra, and which face blocks they may meet.
struct Task {
  int group;
  std::size_t begin, end;  // in Parts::task_faces
  const struct Worker* found_by = nullptr;
  std::size_t first_pair = 0, num_pairs = 0;
};

struct Worker {
  BoxList faces;  // of one task: blocks of faces
  // Of one block of tetrahedra: faces that reach into its box.
  std::vector<int> face_blocks;
  std::vector<std::uint16_t> face_masks;
  std::vector<std::uint32_t> accepted, doubtful;
  std::vector<Penetration> pairs;
  std::int64_t candidates = 0, doubts = 0;
};

}  // namespace

struct BlockQueryScratch::Parts {
  std::shared_ptr<ThreadPool> pool;
  std::vector<Worker> workers;  // of each thread
  // The face blocks within reach, their boxes and those of their faces in the frame of W.
  std::vector<int> face_blocks;
  std::vector<FloatBox> face_block_boxes;
  std::vector<BoxGroup> face_boxes;
  std::vector<BoxList> lists;  // a level
  std::vector<Task> tasks;
  std::vector<int> task_faces;  // indices into face_blocks
};

BlockQueryScratch::BlockQueryScratch(std::shared_ptr<ThreadPool> pool)
    : parts_(std::make_unique<Parts>()) {
  parts_->workers.resize(static_cast<std::size_t>(pool->num_threads()));
  parts_->pool = std::move(pool);
}
BlockQueryScratch::~BlockQueryScratch() = default;
BlockQueryScratch::BlockQueryScratch(BlockQueryScratch&&) noexcept = default;
BlockQueryScratch& BlockQueryScratch::operator=(BlockQueryScratch&&) noexcept = default;

namespace {

template <class T>
std::size_t bytes(const std::vector<T>& list) {
  return list.capacity() * sizeof(T);
}
std::size_t bytes(const BoxList& list) { return bytes(list.groups) + bytes(list.ids); }

}  // namespace

std::size_t BlockQueryScratch::memory() const {
  const Parts& s = *parts_;
  std::size_t sum = sizeof(Parts) + bytes(s.face_boxes) + bytes(s.face_blocks) + bytes(s.lists) +
                    bytes(s.tasks) + bytes(s.task_faces) + bytes(s.workers);
  for (const BoxList& list : s.lists) sum += bytes(list);
  for (const Worker& w : s.workers)
    sum += bytes(w.faces) + bytes(w.face_blocks) + bytes(w.face_masks) + bytes(w.accepted) +
           bytes(w.doubtful) + bytes(w.pairs);
  return sum;
}

namespace {

/// One direction of a query: faces of F in tetrahedra of W.
class Search {
 public:
  Search(const BlockTree& F, const BlockTree& W, bool one_mesh, const BlockQueryOptions& options,
         BlockQueryScratch::Parts& scratch)
      : F_(F),
        W_(W),
        one_mesh_(one_mesh),
        narrow_(options.narrow),
        kernels_(block_kernels(options.instruction_set)),
        s_(scratch) {}

  /// Fills s.tasks.
  void find_tasks() const {
    s_.tasks.clear();
    s_.task_faces.clear();
    const std::size_t num_levels = W_.tet_levels().size();
    if (s_.lists.size() <= num_levels) s_.lists.resize(num_levels + 1);
    BoxList& top = s_.lists[num_levels];
    top.clear();
    if (W_.num_tets() > 0) collect_faces(top);
    if (top.ids.empty()) return;
    descend(W_.tet_levels().size() - 1, 0, top);
  }

  void run_task(const Task& task, Worker& worker) const {
    worker.faces.clear();
    for (std::size_t i = task.begin; i < task.end; ++i) {
      const int face_block = s_.task_faces[i];
      worker.faces.push(s_.face_block_boxes[static_cast<std::size_t>(face_block)], face_block);
    }
    const BoxGroup& blocks = W_.tet_levels()[0][static_cast<std::size_t>(task.group)];
    const int first = task.group * kBlockSize;
    const int num = std::min(kBlockSize, W_.num_tet_blocks() - first);
    for (int i = 0; i < num; ++i)
      test_block(first + i, box_in(blocks, static_cast<std::size_t>(i)), worker);
  }

 private:
  /// The face blocks of F that reach into the box of W.
  void collect_faces(BoxList& list) const {
    const FrameChange into_w(F_, W_);
    const FloatBox root = union_of(W_.tet_levels().back()[0]);
    s_.face_boxes.clear();
    s_.face_blocks.clear();
    s_.face_block_boxes.clear();
    for (int block = 0; block < F_.num_face_blocks(); ++block) {
      const BoxGroup& group = F_.face_boxes()[static_cast<std::size_t>(block)];
      const FloatBox box = into_w(union_of(group));
      if (!overlap(box, root)) continue;
      list.push(box, static_cast<int>(s_.face_blocks.size()));
      s_.face_blocks.push_back(block);
      s_.face_block_boxes.push_back(box);
      BoxGroup& moved = s_.face_boxes.emplace_back();
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        put(into_w(box_in(group, lane)), moved, lane);
    }
  }

  /// Of the boxes in the list those that overlap the box.
  void filter(const BoxList& list, const FloatBox& box, BoxList& result) const {
    result.clear();
    for (std::size_t g = 0; g < list.groups.size(); ++g)
      for_each_bit(kernels_.overlapping(list.groups[g], box), [&](std::size_t lane) {
        result.push(box_in(list.groups[g], lane), list.ids[kLanes * g + lane]);
      });
  }

  /// Down a group of the tree over W's blocks, with the face blocks that may meet it.
  void descend(std::size_t level, std::size_t group, const BoxList& faces) const {
    if (level == 0) {
      const std::size_t begin = s_.task_faces.size();
      s_.task_faces.insert(s_.task_faces.end(), faces.ids.begin(), faces.ids.end());
      s_.tasks.push_back({static_cast<int>(group), begin, s_.task_faces.size()});
      return;
    }
    const BoxGroup& children = W_.tet_levels()[level][group];
    const std::size_t num = std::min(kLanes, W_.tet_levels()[level - 1].size() - kLanes * group);
    for (std::size_t lane = 0; lane < num; ++lane) {
      BoxList& below = s_.lists[level - 1];
      filter(faces, box_in(children, lane), below);
      if (!below.ids.empty()) descend(level - 1, kLanes * group + lane, below);
    }
  }

  void test_block(int block, const FloatBox& box, Worker& worker) const {
    worker.face_blocks.clear();
    worker.face_masks.clear();
    for (std::size_t g = 0; g < worker.faces.groups.size(); ++g)
      for_each_bit(kernels_.overlapping(worker.faces.groups[g], box), [&](std::size_t lane) {
        const auto i = static_cast<std::size_t>(worker.faces.ids[kLanes * g + lane]);
        const unsigned mask = kernels_.overlapping(s_.face_boxes[i], box);
        if (mask == 0) return;
        worker.face_blocks.push_back(s_.face_blocks[i]);
        worker.face_masks.push_back(static_cast<std::uint16_t>(mask));
        if (worker.face_blocks.size() == kMostFaceBlocks) test_faces(block, worker);
      });
    if (!worker.face_blocks.empty()) test_faces(block, worker);
  }

  /// The block against the worker's faces, which it then forgets.
  void test_faces(int block, Worker& worker) const {
    BlockQuery query;
    W_.describe_block(block, query);
    query.face_corners = F_.face_corner_lanes();
    query.face_nodes = F_.face_node_lanes();
    query.face_blocks = worker.face_blocks.data();
    query.face_masks = worker.face_masks.data();
    query.num_face_blocks = static_cast<int>(worker.face_blocks.size());
    query.one_mesh = one_mesh_;
    query.boxes_only = narrow_ == NarrowTest::Gjk;
    worker.accepted.resize(kLanes * kLanes * kMostFaceBlocks);
    worker.doubtful.resize(kLanes * kLanes * kMostFaceBlocks);
    query.accepted = worker.accepted.data();
    query.doubtful = worker.doubtful.data();
    query.num_accepted = query.num_doubtful = query.num_candidates = 0;
    kernels_.test_block(query);

    worker.candidates += query.num_candidates;
    worker.doubts += query.num_doubtful;
    for (int i = 0; i < query.num_accepted; ++i) report(query.accepted[i], block, worker);
    for (int i = 0; i < query.num_doubtful; ++i) {
      const std::uint32_t id = query.doubtful[i];
      if (elements_meet(F_.face_corners(face_slot(id, worker)), W_.tet_corners(tet_slot(id, block)),
                        W_.margin(), narrow_))
        report(id, block, worker);
    }
    worker.face_blocks.clear();
    worker.face_masks.clear();
  }

  // The ids of BlockQuery.
  static int face_slot(std::uint32_t id, const Worker& worker) {
    return worker.face_blocks[id / 256] * kBlockSize + static_cast<int>(id / kLanes % kLanes);
  }
  static int tet_slot(std::uint32_t id, int block) {
    return block * kBlockSize + static_cast<int>(id % kLanes);
  }
  void report(std::uint32_t id, int block, Worker& worker) const {
    worker.pairs.push_back({F_.face_in(face_slot(id, worker)), W_.tet_in(tet_slot(id, block))});
  }

  const BlockTree& F_;
  const BlockTree& W_;
  bool one_mesh_;
  NarrowTest narrow_;
  const BlockKernels& kernels_;
  BlockQueryScratch::Parts& s_;
};

/// Each worker keeps the pairs that it finds.
void run_tasks(const Search& search, BlockQueryScratch::Parts& s) {
  for (Worker& worker : s.workers) {
    worker.pairs.clear();
    worker.candidates = worker.doubts = 0;
  }
  s.pool->run(static_cast<int>(s.tasks.size()), [&](int k, int w) {
    Task& task = s.tasks[static_cast<std::size_t>(k)];
    Worker& worker = s.workers[static_cast<std::size_t>(w)];
    task.found_by = &worker;
    task.first_pair = worker.pairs.size();
    search.run_task(task, worker);
    task.num_pairs = worker.pairs.size() - task.first_pair;
  });
}

/// The pairs in the order of the tasks, whoever found them.
void gather(BlockQueryScratch::Parts& s, std::vector<Penetration>& pairs) {
  pairs.clear();
  if (s.workers.size() == 1) {
    pairs.swap(s.workers[0].pairs);
    return;
  }
  for (const Task& task : s.tasks) {
    const auto first = task.found_by->pairs.begin() + static_cast<std::ptrdiff_t>(task.first_pair);
    pairs.insert(pairs.end(), first, first + static_cast<std::ptrdiff_t>(task.num_pairs));
  }
}

/// Sorts by a key from 0 to num_keys - 1; what has the same key keeps its order.
template <class Key>
void sort_by(std::vector<Penetration>& pairs, int num_keys, Key&& key, SortScratch& scratch) {
  scratch.begin.assign(static_cast<std::size_t>(num_keys) + 1, 0);
  for (const Penetration& pair : pairs) ++scratch.begin[static_cast<std::size_t>(key(pair)) + 1];
  std::partial_sum(scratch.begin.begin(), scratch.begin.end(), scratch.begin.begin());
  scratch.sorted.resize(pairs.size());
  for (const Penetration& pair : pairs)
    scratch.sorted[scratch.begin[static_cast<std::size_t>(key(pair))]++] = pair;
  pairs.swap(scratch.sorted);
}

void query(const BlockTree& F, const BlockTree& W, bool one_mesh, std::vector<Penetration>& pairs,
           BlockQueryCounts& counts, BlockQueryScratch& scratch, const BlockQueryOptions& options) {
  if (!F.is_fitted() || !W.is_fitted()) bad_input("a tree that has moved and was not fitted");
  BlockQueryScratch::Parts& s = scratch.parts();
  const Clock::time_point start = Clock::now();
  const Search search(F, W, one_mesh, options, s);
  search.find_tasks();
  counts.traverse_seconds += seconds_since(start);

  const Clock::time_point narrow_start = Clock::now();
  run_tasks(search, s);
  gather(s, pairs);
  counts.narrow_seconds += seconds_since(narrow_start);
  for (const Worker& worker : s.workers) {
    counts.candidates += worker.candidates;
    counts.doubtful += worker.doubts;
  }
  counts.pairs += static_cast<std::int64_t>(pairs.size());
}

}  // namespace

void faces_in_body(const BlockTree& F, const BlockTree& W, std::vector<Penetration>& pairs,
                   BlockQueryCounts& counts, BlockQueryScratch& scratch,
                   const BlockQueryOptions& options) {
  if (F.num_updates() > 0 && W.num_updates() > 0 && F.margin() != W.margin())
    bad_input("trees with margins of ", F.margin(), " m and ", W.margin(), " m, must be the same");
  query(F, W, false, pairs, counts, scratch, options);
}

void faces_in_own_body(const BlockTree& tree, std::vector<Penetration>& pairs,
                       BlockQueryCounts& counts, BlockQueryScratch& scratch,
                       const BlockQueryOptions& options) {
  query(tree, tree, true, pairs, counts, scratch, options);
}

void sort_pairs(std::vector<Penetration>& pairs, const BlockTree& F, const BlockTree& W,
                SortScratch& scratch) {
  sort_by(
      pairs, W.num_tets(), [](const Penetration& p) { return p.tetrahedron; }, scratch);
  sort_by(
      pairs, F.num_faces(), [](const Penetration& p) { return p.face; }, scratch);
}

}  // namespace articular::collision
