#include "visibility/hardware_cull.hpp"

#include "visibility/drawable_bounds.hpp"

#include <algorithm>
#include <functional>

namespace triptych {

namespace {

/// Of many pieces only this number is tested first, the largest on the screen: if any shows, it is often one
/// of them.
constexpr size_t largest_pieces = 2;

/// Keeps the `count` largest of the rectangles from `first` on.
void keep_largest(std::vector<ScreenRectangle>& rectangles, size_t first, size_t count) {
  const auto area = [](const ScreenRectangle& r) { return (r.right - r.left) * (r.top - r.bottom); };
  const auto begin = rectangles.begin() + static_cast<std::ptrdiff_t>(first);
  std::partial_sort(begin, begin + static_cast<std::ptrdiff_t>(count), rectangles.end(),
                    [&](const ScreenRectangle& a, const ScreenRectangle& b) { return area(a) > area(b); });
  rectangles.resize(first + count);
}

}  // namespace

HardwareCull::HardwareCull(const Hierarchy& hierarchy, const CullOptions& options, uint32_t min_pixels)
    : hierarchy_(hierarchy),
      skeleton_(hierarchy.skeleton()),
      options_(options),
      min_pixels_(min_pixels),
      expected_(skeleton_.scene_nodes.size()),
      represented_(skeleton_.drawables.size()),
      shown_(skeleton_.drawables.size()),
      was_visible_(skeleton_.drawables.size()) {}

const CullResult& HardwareCull::run(const FrameView& view, LazyCut& cut, OcclusionTester& tester,
                                    std::span<const DrawableId> represented, const VisibleSet& previous,
                                    CullSink& sink) {
  const BoxProjector projector(view, tester.margins());
  view_ = &view;
  cut_ = &cut;
  projector_ = &projector;
  tester_ = &tester;
  begin(represented, previous);
  push(0);
  do {
    fill_batch();
    test_batch();
    if (!found_.empty() && !queue_.empty()) tester.draw(found_);
    found_.clear();
    decide();
    if (queue_.empty() || packet_.delta.size() >= options_.packet_ids) emit(sink);
  } while (!queue_.empty());
  std::sort(result_.visible.begin(), result_.visible.end());
  result_.selected = cut.selected();
  return result_;
}

void HardwareCull::begin(std::span<const DrawableId> represented, const VisibleSet& previous) {
  result_.clear();
  queue_.clear();
  found_.clear();
  previous_.clear();
  for (EpochMarks* marks : {&expected_, &represented_, &shown_, &was_visible_}) marks->clear();
  batch_ =
      !represented.empty() && represented.size() * 2 >= previous.size() ? options_.batch : options_.min_batch;
  next_previous_ = found_visible_ = 0;
  for (const DrawableId id : represented) represented_.mark(id);
  for (const DrawableId id : previous) {
    was_visible_.mark(id);
    previous_.push_back(draw_rank(*view_, id));
    for (SceneNodeId node = skeleton_.drawables[id].scene_node; node != no_id && expected_.mark_first(node);
         node = skeleton_.scene_nodes[node].parent) {
    }
  }
  std::sort(previous_.begin(), previous_.end());
}

void HardwareCull::push(SceneNodeId node) {
  if (cut_->choice(node) != no_id) enqueue({squared_distance(view_->cell, view_->box(node)), node});
}

void HardwareCull::push_children(SceneNodeId id) {
  const SceneNode& node = skeleton_.scene_nodes[id];
  for (uint32_t child = 0; child < node.child_count; ++child) push(node.first_child + child);
}

void HardwareCull::enqueue(const QueueEntry& entry) {
  queue_.push_back(entry);
  std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
}

HardwareCull::QueueEntry HardwareCull::dequeue() {
  std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
  const QueueEntry entry = queue_.back();
  queue_.pop_back();
  return entry;
}

void HardwareCull::show(SceneNodeId node) {
  const DrawableId id = cut_->choice(node);
  const FrameRules& rules = view_->rules;
  // Without the rule every fourth is left out; the nearest alone is often a large box that owns no pixel.
  if (!rules.show_all_found && ++found_visible_ % 4 == 0) return;
  if (!rules.retest_hidden && !previous_.empty() && !was_visible_.marked(id)) return;
  result_.visible.push_back(id);
  shown_.mark(id);
  if (!was_visible_.marked(id)) packet_.delta.added.push_back(id);
  if (!represented_.marked(id)) found_.push_back(id);
}

/// Whether it may show without being drawn first, or with few others that are not drawn yet.
bool HardwareCull::may_show(SceneNodeId node) const {
  return represented_.marked(cut_->choice(node)) || found_.empty() || found_.size() < options_.max_found;
}

/// Takes scene nodes in rank order until `batch_` of them need a test.
void HardwareCull::fill_batch() {
  tested_.clear();
  rectangles_.clear();
  ends_.clear();
  while (!queue_.empty() && tested_.size() < batch_) {
    QueueEntry next = dequeue();
    const SceneNodeId id = next.node;
    const bool inner = cut_->choice(id) == Cut::inner;
    if (inner && expected_.marked(id)) {
      push_children(id);
      continue;
    }
    const ScreenBounds::Kind kind = append_bounds(next, inner);
    if (kind == ScreenBounds::Kind::off_screen) continue;
    // What is known to be hidden has no rectangles: its test says so, and counts.
    if (kind == ScreenBounds::Kind::rectangle || kind == ScreenBounds::Kind::hidden) {
      tested_.push_back(next);
      ends_.push_back(static_cast<uint32_t>(rectangles_.size()));
    } else if (inner) {
      push_children(id);
    } else {
      ++result_.untested;
      show(id);
    }
  }
}

ScreenBounds::Kind HardwareCull::append_bounds(QueueEntry& entry, bool inner) {
  if (!inner) return append_bounds_of(entry);
  const ScreenBounds bounds = projector_->bounds(view_->box(entry.node), tester_);
  if (bounds.kind == ScreenBounds::Kind::rectangle) rectangles_.push_back(bounds.rectangle);
  return bounds.kind;
}

/// The boxes of its placements come first, since most of what is tested is hidden; then, or at once if it
/// was visible one frame ago, those of its pieces: the largest first.
ScreenBounds::Kind HardwareCull::append_bounds_of(QueueEntry& entry) {
  const DrawableId id = cut_->choice(entry.node);
  const HiddenObjects* const hidden = view_->state.hiding.objects.get();
  const auto gone = hidden ? hidden->hidden_placements(entry.node) : std::span<const PlacementRun>();
  if (!has_pieces(hierarchy_, id)) {
    entry.boxes = Boxes::all;
    return append_placement_bounds(hierarchy_, *projector_, id, tester_, rectangles_, gone);
  }
  const size_t first = rectangles_.size();
  if (entry.boxes == Boxes::placements && !was_visible_.marked(id)) {
    const ScreenBounds::Kind kind =
        append_placement_bounds(hierarchy_, *projector_, id, tester_, rectangles_, gone);
    if (kind != ScreenBounds::Kind::unbounded) return kind;
  }
  const ScreenBounds::Kind kind = append_drawable_bounds(hierarchy_, *projector_, id, rectangles_, gone);
  if (entry.boxes == Boxes::all || rectangles_.size() - first <= 2 * largest_pieces) {
    entry.boxes = Boxes::all;
  } else {
    entry.boxes = Boxes::largest_pieces;
    keep_largest(rectangles_, first, largest_pieces);
  }
  return kind;
}

void HardwareCull::test_batch() {
  if (tested_.empty()) return;
  answers_.assign(tested_.size(), 1);
  tester_->test(rectangles_, ends_, min_pixels_, answers_);
  ++result_.batches;
  result_.tests += tested_.size();
  bool too_many = false;
  for (size_t i = 0; i < tested_.size(); ++i) {
    const SceneNodeId node = tested_[i].node;
    const bool inner = cut_->choice(node) == Cut::inner;
    if (options_.observer != nullptr) options_.observer->tested(node, answers_[i] != 0);
    if (inner && answers_[i]) push_children(node);
    if (inner && !answers_[i]) ++result_.hidden_subtrees;
    if (!inner) judge(tested_[i], answers_[i] != 0, too_many);
  }
  batch_ = too_many ? std::min(batch_, options_.min_batch) : std::min(2 * batch_, options_.batch);
}

/// Shows a drawable, drops it, or has it tested once more.
void HardwareCull::judge(QueueEntry tested, bool passed, bool& too_many) {
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
  enqueue(tested);
}

/// Moves the watermark on: drawables of V(i−1) below it that did not show are removed.
void HardwareCull::decide() {
  packet_.watermark = queue_.empty() ? everything_decided : DrawRank{queue_.front().distance, 0};
  for (; next_previous_ < previous_.size() && previous_[next_previous_] < packet_.watermark;
       ++next_previous_) {
    const DrawableId id = previous_[next_previous_].id;
    if (!shown_.marked(id)) packet_.delta.removed.push_back(id);
  }
}

void HardwareCull::emit(CullSink& sink) {
  std::sort(packet_.delta.added.begin(), packet_.delta.added.end());
  std::sort(packet_.delta.removed.begin(), packet_.delta.removed.end());
  sink.take(packet_);
  packet_.delta.added.clear();
  packet_.delta.removed.clear();
}

}  // namespace triptych
