#include "measure/explanation.hpp"

#include "base/error.hpp"
#include "visibility/drawable_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {
LocalPipelineOptions of_size(int width, int height) {
  LocalPipelineOptions options;
  options.width = width;
  options.height = height;
  return options;
}
}  // namespace

Explainer::Explainer(const Pack& pack, int width, int height, const DeviceOptions& device)
    : skeleton_(pack.skeleton()),
      device_(pack, device),
      strategy_(device_.hierarchy(), {.observer = this}),
      pipeline_(device_.hierarchy(), device_.device(), strategy_, of_size(width, height)),
      item_stage_(device_.device(), width, height, TargetKind::item) {}

void Explainer::draw(const FrameRequest& frame) {
  tests_.clear();
  items_.clear();
  frame_ = frame;
  record_ = pipeline_.draw(frame);
}

const std::vector<uint32_t>& Explainer::items() {
  if (items_.empty()) {
    std::vector<DrawableId> ordered = record_.visible;
    const FrameView frame_view = view();
    sort_by_rank(frame_view, ordered);
    item_stage_.begin(frame_view);
    item_stage_.draw(ordered);
    items_ = item_stage_.target().read_items();
  }
  return items_;
}

std::optional<DrawableId> Explainer::at(int x, int y) {
  const View& view = frame_.state.view;
  if (x < 0 || y < 0 || x >= view.width || y >= view.height) {
    fail(fmt::format("pixel {},{}", x, y), "lies outside the picture of {}x{}", view.width, view.height);
  }
  const auto row = static_cast<size_t>(view.height - 1 - y);
  const uint32_t item = items()[row * static_cast<size_t>(view.width) + static_cast<size_t>(x)];
  return item > 0 ? std::optional(item - 1) : std::nullopt;
}

DrawableFacts Explainer::facts_of(DrawableId id) const {
  const Drawable& drawable = skeleton_.drawables[id];
  const SceneNode& node = skeleton_.scene_nodes[drawable.scene_node];
  DrawableFacts facts{.id = id,
                      .scene_node = drawable.scene_node,
                      .level = id - node.first_drawable,
                      .levels = node.drawable_count,
                      .triangles = drawable.triangles,
                      .error = drawable.error};
  for (SceneNodeId up = drawable.scene_node; up != no_id; up = skeleton_.scene_nodes[up].parent)
    ++facts.depth;
  const FrameView frame_view = view();
  facts.pixels = projected_error(frame_view.focal_length, drawable.error,
                                 frame_view.eye_space.bounds(frame_view.box(drawable.scene_node)));
  return facts;
}

std::optional<DrawableFacts> Explainer::next_coarser(DrawableId id) const {
  SceneNodeId node = skeleton_.drawables[id].scene_node;
  const SceneNode& own = skeleton_.scene_nodes[node];
  if (id + 1 < own.first_drawable + own.drawable_count) return facts_of(id + 1);
  while ((node = skeleton_.scene_nodes[node].parent) != no_id) {
    if (skeleton_.scene_nodes[node].drawable_count > 0) {
      return facts_of(skeleton_.scene_nodes[node].first_drawable);
    }
  }
  return std::nullopt;
}

DrawableExplanation Explainer::explain(DrawableId id) {
  if (id >= skeleton_.drawables.size()) {
    fail(fmt::format("drawable {}", id), "the pack has {} drawables, counted from 0",
         skeleton_.drawables.size());
  }
  DrawableExplanation explanation;
  explanation.facts = facts_of(id);
  const uint32_t item = id + 1;
  explanation.pixels_owned = static_cast<uint64_t>(std::count(items().begin(), items().end(), item));
  if (strategy_.cut().choice(explanation.facts.scene_node) != id) {
    explain_cut(explanation);
    return explanation;
  }
  explanation.coarser = next_coarser(id);
  explanation.finest_there_is = !(explanation.facts.pixels <= frame_.state.pixel_error);
  explain_culling(explanation);
  return explanation;
}

void Explainer::explain_cut(DrawableExplanation& explanation) {
  const auto choice = [&](SceneNodeId at) { return strategy_.cut().choice(at); };
  const SceneNodeId own = explanation.facts.scene_node;
  if (choice(own) == Cut::inner) {
    explanation.fate = Fate::finer;
    name_descendants(own, explanation);
    return;
  }
  const FrameView frame_view = view();
  for (SceneNodeId node = own; node != no_id; node = skeleton_.scene_nodes[node].parent) {
    if (frame_view.eye_space.bounds(frame_view.box(node)).outside) explanation.decided_at = node;
    if (choice(node) >= Cut::inner) continue;
    explanation.by = {facts_of(choice(node))};
    explanation.fate = node == own && choice(node) < explanation.facts.id ? Fate::finer : Fate::coarser;
  }
  if (explanation.by.empty()) {
    explanation.fate = Fate::outside_frustum;
  } else {
    explanation.decided_at = no_id;
  }
}

void Explainer::name_descendants(SceneNodeId node, DrawableExplanation& explanation) {
  const auto choice = [&](SceneNodeId at) { return strategy_.cut().choice(at); };
  std::vector<SceneNodeId> open = {node};
  std::map<uint32_t, uint64_t> owned;
  for (const uint32_t item : items()) ++owned[item];
  std::vector<std::pair<uint64_t, DrawableId>> found;  // pixels, id
  while (!open.empty()) {
    const SceneNode& inner = skeleton_.scene_nodes[open.back()];
    open.pop_back();
    for (SceneNodeId child = inner.first_child; child < inner.first_child + inner.child_count; ++child) {
      if (choice(child) == Cut::inner) open.push_back(child);
      if (choice(child) >= Cut::inner) continue;
      found.emplace_back(owned[choice(child) + 1], choice(child));
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& one, const auto& other) {
    return one.first != other.first ? one.first > other.first : one.second < other.second;
  });
  for (const auto& [pixels, id] : found) {
    explanation.by.push_back(facts_of(id));
    explanation.by_pixels.push_back(pixels);
  }
}

void Explainer::explain_culling(DrawableExplanation& explanation) {
  if (std::binary_search(record_.visible.begin(), record_.visible.end(), explanation.facts.id)) {
    explanation.fate = Fate::drawn;
    return;
  }
  explanation.fate = Fate::withheld;
  const BoxProjector projector(view());
  for (SceneNodeId node = explanation.facts.scene_node; node != no_id;
       node = skeleton_.scene_nodes[node].parent) {
    const auto test = tests_.find(node);
    const bool hidden = test != tests_.end() && !test->second;
    // A scene node is not tested where its box covers no pixel's centre; those above it may be.
    const bool between_pixels = node == explanation.facts.scene_node &&
                                drawable_bounds(device_.hierarchy(), projector, explanation.facts.id).kind ==
                                    ScreenBounds::Kind::off_screen;
    if (!hidden && !between_pixels) continue;
    explanation.fate = hidden ? Fate::hidden : Fate::between_pixels;
    explanation.decided_at = node;
  }
  if (explanation.fate != Fate::hidden) return;
  name_what_is_in_front(explanation);
  if (explanation.by.empty()) explanation.fate = Fate::between_pixels;
}

void Explainer::name_what_is_in_front(DrawableExplanation& explanation) {
  const BoxProjector projector(view());
  std::vector<ScreenRectangle> rectangles;
  if (explanation.decided_at == explanation.facts.scene_node) {
    rectangles = drawable_bounds(device_.hierarchy(), projector, explanation.facts.id).rectangles;
  } else {
    rectangles = {projector.bounds(projector.box(explanation.decided_at)).rectangle};
  }
  const int width = frame_.state.view.width, height = frame_.state.view.height;
  const auto device = [](int at, int side) { return static_cast<float>((2 * at + 1.0) / side - 1); };
  std::map<uint32_t, uint64_t> owners;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool tested =
          std::any_of(rectangles.begin(), rectangles.end(), [&](const ScreenRectangle& rectangle) {
            return rectangle.covers(device(x, width), device(y, height));
          });
      if (!tested) continue;
      ++owners[items()[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)]];
    }
  }
  std::vector<std::pair<uint64_t, uint32_t>> ordered;
  for (const auto& [item, count] : owners) {
    if (item > 0) ordered.emplace_back(count, item);
  }
  std::sort(ordered.rbegin(), ordered.rend());
  for (const auto& [count, item] : ordered) {
    explanation.by.push_back(facts_of(item - 1));
    explanation.by_pixels.push_back(count);
  }
}

}  // namespace triptych
