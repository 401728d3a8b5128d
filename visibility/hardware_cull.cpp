#include "visibility/hardware_cull.hpp"

#include "base/inject.hpp"
#include "visibility/drawable_bounds.hpp"

#include <algorithm>
#include <limits>
#include <queue>

namespace triptych {

namespace {

/// What a drawable is tested by: ever more boxes, ever closer ones.
enum class Boxes : uint8_t { placements, largest_pieces, all };

/// Of many, the largest on the screen: where any shows, it is often one of these.
constexpr size_t largest_pieces = 2;

/// A scene node that waits for its turn.
struct Waiting {
  uint64_t distance;
  SceneNodeId node;
  Boxes boxes = Boxes::placements;
  auto operator<=>(const Waiting&) const = default;
};

void keep_largest(std::vector<ScreenRectangle>& rectangles, size_t count) {
  const auto area = [](const ScreenRectangle& r) { return (r.right - r.left) * (r.top - r.bottom); };
  std::partial_sort(rectangles.begin(), rectangles.begin() + static_cast<std::ptrdiff_t>(count),
                    rectangles.end(),
                    [&](const ScreenRectangle& a, const ScreenRectangle& b) { return area(a) > area(b); });
  rectangles.resize(count);
}

class HardwareCull {
 public:
  HardwareCull(const Skeleton& skeleton, const View& view, const Cut& cut, OcclusionTester& tester,
               const std::vector<DrawableId>& represented, const VisibleSet& previous,
               const CullOptions& options)
      : skeleton_(skeleton),
        cut_(cut),
        tester_(tester),
        projector_(skeleton, view),
        cell_(eye_cell(skeleton, view)),
        options_(options),
        batch_(!represented.empty() && represented.size() * 2 >= previous.size() ? options.batch
                                                                                 : options.least_batch),
        expected_(skeleton.scene_nodes.size(), false),
        represented_(skeleton.drawables.size(), false),
        shown_(skeleton.drawables.size(), false),
        was_visible_(skeleton.drawables.size(), false) {
    for (const DrawableId id : represented) represented_[id] = true;
    for (const DrawableId id : previous) {
      was_visible_[id] = true;
      previous_.push_back(draw_rank(skeleton, cell_, id));
      for (SceneNodeId node = skeleton.drawables[id].scene_node; node != no_id && !expected_[node];
           node = skeleton.scene_nodes[node].parent) {
        expected_[node] = true;
      }
    }
    std::sort(previous_.begin(), previous_.end());
  }

  CullResult run(const std::function<void(const CullPacket&)>& emit) {
    push(0);
    do {
      fill_batch();
      test_batch();
      draw_found();
      decide();
      if (queue_.empty() || packet_.delta.size() >= options_.packet_ids) emit(take_packet());
    } while (!queue_.empty());
    std::sort(result_.visible.begin(), result_.visible.end());
    return std::move(result_);
  }

 private:
  void push(SceneNodeId node) {
    if (cut_.choice[node] != no_id)
      queue_.push({squared_distance(cell_, skeleton_.scene_nodes[node].box), node});
  }
  void push_children(SceneNodeId id) {
    const SceneNode& node = skeleton_.scene_nodes[id];
    for (uint32_t child = 0; child < node.child_count; ++child) push(node.first_child + child);
  }

  void show(SceneNodeId node) {
    const DrawableId id = cut_.choice[node];
    // Many, since what is nearest is often a large box that owns no pixel.
    if (injected(Fault::withheld_id) && ++found_visible_ % 4 == 0) return;
    if (injected(Fault::carried_hidden) && !previous_.empty() && !was_visible_[id]) return;
    result_.visible.push_back(id);
    shown_[id] = true;
    if (!was_visible_[id]) packet_.delta.added.push_back(id);
    if (!represented_[id]) found_.push_back(id);
  }

  /// Whether it may show without being drawn first, or with few others that are not drawn yet.
  bool may_show(SceneNodeId node) const {
    return represented_[cut_.choice[node]] || found_.empty() || found_.size() < options_.most_found;
  }

  /// Takes scene nodes in rank order until `batch_` of them want a test.
  void fill_batch() {
    tested_.clear();
    rectangles_.clear();
    ends_.clear();
    while (!queue_.empty() && tested_.size() < batch_) {
      Waiting next = queue_.top();
      const SceneNodeId id = next.node;
      queue_.pop();
      const bool inner = cut_.choice[id] == Cut::inner;
      if (inner && expected_[id]) {
        push_children(id);
        continue;
      }
      const DrawableBounds bounds = inner ? node_bounds(id) : bounds_of(next);
      if (bounds.kind == ScreenBounds::Kind::off_screen) continue;
      if (bounds.kind == ScreenBounds::Kind::rectangle) {
        tested_.push_back(next);
        rectangles_.insert(rectangles_.end(), bounds.rectangles.begin(), bounds.rectangles.end());
        ends_.push_back(static_cast<uint32_t>(rectangles_.size()));
      } else if (inner) {
        push_children(id);
      } else {
        ++result_.untested;
        show(id);
      }
    }
  }

  DrawableBounds node_bounds(SceneNodeId id) const {
    const ScreenBounds bounds = projector_.bounds(skeleton_.scene_nodes[id].box);
    return {bounds.kind, {bounds.rectangle}};
  }

  /// By the boxes of its placements first, since most of what is tested is hidden; then, or where it was
  /// visible a frame ago, by its pieces: the largest first.
  DrawableBounds bounds_of(Waiting& waiting) const {
    const DrawableId id = cut_.choice[waiting.node];
    if (!has_pieces(skeleton_, id)) {
      waiting.boxes = Boxes::all;
      return placement_bounds(skeleton_, projector_, id);
    }
    if (waiting.boxes == Boxes::placements && !was_visible_[id]) {
      const DrawableBounds bounds = placement_bounds(skeleton_, projector_, id);
      if (bounds.kind != ScreenBounds::Kind::unbounded) return bounds;
    }
    DrawableBounds bounds = drawable_bounds(skeleton_, projector_, id);
    if (waiting.boxes == Boxes::all || bounds.rectangles.size() <= 2 * largest_pieces) {
      waiting.boxes = Boxes::all;
    } else {
      waiting.boxes = Boxes::largest_pieces;
      keep_largest(bounds.rectangles, largest_pieces);
    }
    return bounds;
  }

  void test_batch() {
    if (tested_.empty()) return;
    answers_.assign(tested_.size(), 1);
    tester_.test(rectangles_, ends_, answers_);
    ++result_.batches;
    result_.tests += tested_.size();
    bool too_many = false;
    for (size_t i = 0; i < tested_.size(); ++i) {
      const SceneNodeId node = tested_[i].node;
      const bool inner = cut_.choice[node] == Cut::inner;
      if (options_.on_test) options_.on_test(node, answers_[i] != 0);
      if (inner && answers_[i]) push_children(node);
      if (inner && !answers_[i]) ++result_.hidden_subtrees;
      if (!inner) judge(tested_[i], answers_[i] != 0, too_many);
    }
    batch_ = too_many ? std::min(batch_, options_.least_batch) : std::min(2 * batch_, options_.batch);
  }

  /// Shows a drawable, drops it, or has it tested once more.
  void judge(Waiting tested, bool passed, bool& too_many) {
    if (!passed) {
      if (tested.boxes != Boxes::largest_pieces) return;
      tested.boxes = Boxes::all;
    } else if (tested.boxes == Boxes::placements) {
      tested.boxes = Boxes::largest_pieces;
    } else if (may_show(tested.node)) {
      show(tested.node);
      return;
    } else {
      too_many = true;
    }
    queue_.push(tested);
  }

  void draw_found() {
    if (!found_.empty() && !queue_.empty()) tester_.draw(found_);
    found_.clear();
  }

  /// Moves the watermark on: drawables of V(i−1) below it that did not show are gone.
  void decide() {
    packet_.watermark = queue_.empty() ? DrawRank{std::numeric_limits<uint64_t>::max(), no_id}
                                       : DrawRank{queue_.top().distance, 0};
    for (; next_previous_ < previous_.size() && previous_[next_previous_] < packet_.watermark;
         ++next_previous_) {
      const DrawableId id = previous_[next_previous_].id;
      if (!shown_[id]) packet_.delta.removed.push_back(id);
    }
  }

  CullPacket take_packet() {
    CullPacket packet = std::move(packet_);
    packet_ = {};
    std::sort(packet.delta.added.begin(), packet.delta.added.end());
    std::sort(packet.delta.removed.begin(), packet.delta.removed.end());
    return packet;
  }

  const Skeleton& skeleton_;
  const Cut& cut_;
  OcclusionTester& tester_;
  BoxProjector projector_;
  glm::ivec3 cell_;
  const CullOptions& options_;
  size_t batch_;
  std::vector<bool> expected_, represented_, shown_, was_visible_;
  std::vector<DrawRank> previous_;  ///< V(i−1) in rank order
  size_t next_previous_ = 0;        ///< the first of them that is not decided
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue_;
  std::vector<Waiting> tested_;
  std::vector<ScreenRectangle> rectangles_;
  std::vector<uint32_t> ends_;  ///< for each of tested_ the end of its rectangles
  std::vector<uint8_t> answers_;
  std::vector<DrawableId> found_;
  CullPacket packet_;  ///< what was decided since the last one was sent
  CullResult result_;
  size_t found_visible_ = 0;
};

}  // namespace

CullResult hardware_cull(const Skeleton& skeleton, const View& view, const Cut& cut, OcclusionTester& tester,
                         const std::vector<DrawableId>& represented, const VisibleSet& previous,
                         const CullOptions& options, const std::function<void(const CullPacket&)>& emit) {
  return HardwareCull(skeleton, view, cut, tester, represented, previous, options).run(emit);
}

}  // namespace triptych
