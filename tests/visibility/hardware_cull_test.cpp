// The hardware cull against testers that need no graphics card.
#include "visibility/hardware_cull.hpp"

#include "tests/support/scenes.hpp"
#include "visibility/drawable_bounds.hpp"
#include "visibility/map_to_cut.hpp"
#include "visibility/visible_stream.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

/// Answers as the function says, whatever was drawn.
class FakeTester : public OcclusionTester {
 public:
  explicit FakeTester(std::function<bool(const ScreenRectangle&)> answer) : answer_(std::move(answer)) {}
  void draw(std::span<const DrawableId> drawables) override {
    drawn.insert(drawn.end(), drawables.begin(), drawables.end());
  }
  void test(std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends, uint32_t,
            std::span<uint8_t> visible) override {
    largest_batch = std::max(largest_batch, ends.size());
    for (size_t test = 0, i = 0; test < ends.size(); ++test) {
      visible[test] = 0;
      boxes.push_back(ends[test] - i);
      for (; i < ends[test]; ++i) visible[test] |= answer_(rectangles[i]);
    }
  }
  std::vector<DrawableId> drawn;
  size_t largest_batch = 0;
  std::vector<size_t> boxes;  ///< how many rectangles each test was of

 private:
  std::function<bool(const ScreenRectangle&)> answer_;
};

/// As FakeTester, but what is hidden by a rule over extents it may know without a test.
class KnowingTester final : public FakeTester {
 public:
  KnowingTester(std::function<bool(const ScreenRectangle&)> answer, bool knows)
      : FakeTester([answer = std::move(answer)](const ScreenRectangle& r) {
          return !is_hidden({r.left, r.bottom, r.right, r.top, r.planes[0].middle}) && answer(r);
        }),
        knows_(knows) {}
  bool hides(const ScreenExtent& extent) const override {
    const bool known = knows_ && is_hidden(extent);
    known_ += known;
    return known;
  }
  size_t known() const { return known_; }

 private:
  static bool is_hidden(const ScreenExtent& extent) {
    return static_cast<int>(std::abs(extent.left - extent.top) * 1000 + extent.nearest * 1e5f) % 2 == 0;
  }
  bool knows_;
  mutable size_t known_ = 0;
};

/// Leaves every answer as it found it.
class SilentTester : public OcclusionTester {
 public:
  void draw(std::span<const DrawableId>) override {}
  void test(std::span<const ScreenRectangle>, std::span<const uint32_t>, uint32_t,
            std::span<uint8_t>) override {}
};

bool always(const ScreenRectangle&) { return true; }
bool never(const ScreenRectangle&) { return false; }
/// Some are visible and some are not, at random but each rectangle always the same.
bool some(const ScreenRectangle& rectangle) {
  return static_cast<int>(std::abs(rectangle.left + rectangle.top) * 1000 + rectangle.depth(0, 0) * 1e5f) %
             3 !=
         0;
}

class HardwareCulling : public testing::TestWithParam<std::string> {
 protected:
  const Skeleton& skeleton = scenes::pack(GetParam()).skeleton();
  const std::vector<View> views = scenes::path(skeleton, 320, 240);
  static constexpr size_t packet_ids = 5;
  size_t max_found = CullOptions{}.max_found;
  const Hierarchy hierarchy{skeleton};
  LazyCut lazy{skeleton};
  std::vector<CullPacket> packets;

  /// Keeps what it hears.
  class Listener final : public CullSink {
   public:
    explicit Listener(std::vector<CullPacket>& packets) : packets_(packets) {}
    void take(const CullPacket& packet) override { packets_.push_back(packet); }

   private:
    std::vector<CullPacket>& packets_;
  };

  FrameView view_of(size_t frame) const {
    return FrameView(skeleton, {views[frame], scenes::pixel_error(frame)});
  }
  std::vector<DrawableId> represented(size_t frame, const VisibleSet& previous) {
    lazy.begin(view_of(frame));
    return CutMapper(skeleton).map(lazy, previous);
  }
  CullResult cull(size_t frame, OcclusionTester& tester, const VisibleSet& previous = {}, size_t batch = 48) {
    packets.clear();
    const std::vector<DrawableId> drawn = represented(frame, previous);
    CullOptions options;
    options.batch = options.min_batch = batch;
    options.max_found = max_found;
    options.packet_ids = packet_ids;
    Listener listener(packets);
    const CullResult result =
        HardwareCull(hierarchy, options).run(view_of(frame), lazy, tester, drawn, previous, listener);
    // What was selected on the way is what the whole cut has there.
    const Cut cut = cut_of(frame);
    for (SceneNodeId node = 0; node < skeleton.scene_nodes.size(); ++node)
      EXPECT_EQ(lazy.choice(node), cut.choice[node]) << "frame " << frame << " scene node " << node;
    return result;
  }
  Cut cut_of(size_t frame) const { return select_cut(view_of(frame)); }
  VisibleSet of_kind(size_t frame, const std::function<bool(ScreenBounds::Kind)>& wanted) const {
    const BoxProjector projector(view_of(frame));
    VisibleSet set;
    for (const DrawableId id : cut_of(frame).drawables) {
      if (wanted(drawable_bounds(hierarchy, projector, id).kind)) set.push_back(id);
    }
    std::sort(set.begin(), set.end());
    return set;
  }
  VisibleSet on_screen(size_t frame) const {
    return of_kind(frame, [](ScreenBounds::Kind kind) { return kind != ScreenBounds::Kind::off_screen; });
  }
  VisibleSet untestable(size_t frame) const {
    return of_kind(frame, [](ScreenBounds::Kind kind) { return kind == ScreenBounds::Kind::unbounded; });
  }
};

TEST_P(HardwareCulling, where_every_box_shows_gives_the_whole_cut_on_the_screen) {
  for (size_t frame = 0; frame < views.size(); ++frame) {
    FakeTester tester(always);
    EXPECT_EQ(cull(frame, tester).visible, on_screen(frame)) << "frame " << frame;
  }
}

TEST_P(HardwareCulling, where_no_test_answers_gives_the_whole_cut_on_the_screen) {
  for (size_t frame = 0; frame < views.size(); ++frame) {
    SilentTester tester;
    EXPECT_EQ(cull(frame, tester).visible, on_screen(frame)) << "frame " << frame;
  }
}

TEST_P(HardwareCulling, where_no_box_shows_gives_only_what_cannot_be_tested) {
  for (size_t frame = 0; frame < views.size(); ++frame) {
    FakeTester tester(never);
    const CullResult result = cull(frame, tester);
    EXPECT_EQ(result.visible, untestable(frame)) << "frame " << frame;
    EXPECT_EQ(result.untested, result.visible.size());
  }
}

TEST_P(HardwareCulling, spends_one_test_on_a_hidden_subtree) {
  for (size_t frame = 0; frame < views.size(); ++frame) {
    const Cut cut = cut_of(frame);
    const BoxProjector projector(view_of(frame));
    uint64_t testable = 0, subtrees = 0;
    const std::function<void(SceneNodeId)> visit = [&](SceneNodeId id) {
      if (cut.choice[id] == no_id) return;
      const SceneNode& node = skeleton.scene_nodes[id];
      const bool inner = cut.choice[id] == Cut::inner;
      ScreenBounds::Kind kind = inner ? projector.bounds(node.box).kind
                                      : placement_bounds(hierarchy, projector, cut.choice[id]).kind;
      // Only then its pieces are looked at: many of them twice.
      if (!inner && kind == ScreenBounds::Kind::unbounded) {
        const DrawableBounds pieces = drawable_bounds(hierarchy, projector, cut.choice[id]);
        kind = pieces.kind;
        testable += has_pieces(hierarchy, cut.choice[id]) && pieces.rectangles.size() > 4;
      }
      testable += kind == ScreenBounds::Kind::rectangle;
      subtrees += kind == ScreenBounds::Kind::rectangle && inner;
      if (kind != ScreenBounds::Kind::unbounded || !inner) return;
      for (uint32_t child = 0; child < node.child_count; ++child) visit(node.first_child + child);
    };
    visit(0);
    FakeTester tester(never);
    const CullResult result = cull(frame, tester);
    EXPECT_EQ(result.tests, testable) << "frame " << frame;
    EXPECT_EQ(result.hidden_subtrees, subtrees) << "frame " << frame;
  }
}

TEST_P(HardwareCulling, decides_the_same_where_the_tester_knows_beforehand_what_is_hidden) {
  VisibleSet previous;
  size_t known_beforehand = 0;
  for (size_t frame = 0; frame < views.size(); ++frame) {
    KnowingTester knowing(some, true), asked(some, false);
    const CullResult one = cull(frame, knowing, previous, 7), other = cull(frame, asked, previous, 7);
    EXPECT_EQ(one.visible, other.visible) << "frame " << frame;
    EXPECT_EQ(one.tests, other.tests);
    EXPECT_EQ(one.hidden_subtrees, other.hidden_subtrees);
    EXPECT_EQ(knowing.drawn, asked.drawn);
    EXPECT_LE(knowing.boxes.size(), asked.boxes.size());
    known_beforehand += knowing.known();
    previous = one.visible;
  }
  EXPECT_GT(known_beforehand, 0u);
}

TEST_P(HardwareCulling, sends_packets_that_add_up_to_the_new_set_in_draw_rank_order) {
  VisibleSet previous;
  for (size_t frame = 0; frame < views.size(); ++frame) {
    FakeTester tester(some);
    const CullResult result = cull(frame, tester, previous, 7);
    ASSERT_FALSE(packets.empty());
    const glm::ivec3 cell = eye_cell(skeleton, views[frame]);
    VisibleStream stream(skeleton, {views[frame]}, previous);
    std::vector<DrawableId> decided;
    VisibleSet set = previous;
    for (size_t i = 0; i < packets.size(); ++i) {
      if (i + 1 < packets.size()) {
        EXPECT_GE(packets[i].delta.size(), packet_ids) << "sent too early";
      }
      if (i > 0) {
        EXPECT_LE(packets[i - 1].watermark, packets[i].watermark);
      }
      EXPECT_TRUE(apply_delta(packets[i].delta, set));
      const auto fresh = stream.take(packets[i]);
      decided.insert(decided.end(), fresh.begin(), fresh.end());
      for (const DrawableId id : packets[i].delta.removed) {
        EXPECT_LT(draw_rank(skeleton, cell, id), packets[i].watermark) << "removed, but not decided";
      }
    }
    EXPECT_EQ(set, result.visible) << "frame " << frame;
    EXPECT_EQ(stream.visible(), result.visible);
    EXPECT_EQ(stream.faults(), 0u);
    std::vector<DrawableId> expected = result.visible;
    sort_by_rank(skeleton, cell, expected);
    EXPECT_EQ(decided, expected);
    previous = result.visible;
  }
}

TEST_P(HardwareCulling, gives_the_same_set_in_batches_of_any_size) {
  max_found = SIZE_MAX;  // or some would be tested again
  VisibleSet previous;
  for (size_t frame = 0; frame < views.size(); ++frame) {
    FakeTester reference(some);
    const CullResult expected = cull(frame, reference, previous);
    for (const size_t batch : {size_t{1}, size_t{2}, size_t{13}, size_t{1} << 20}) {
      FakeTester tester(some);
      const CullResult result = cull(frame, tester, previous, batch);
      EXPECT_EQ(result.visible, expected.visible) << "frame " << frame << " in batches of " << batch;
      EXPECT_EQ(result.tests, expected.tests);
      EXPECT_LE(tester.largest_batch, batch);
    }
    previous = expected.visible;
  }
}

/// Everything shows until something was drawn, and nothing after that.
class HiddenByTheFirst : public FakeTester {
 public:
  HiddenByTheFirst() : FakeTester([this](const ScreenRectangle&) { return drawn.empty(); }) {}
};

TEST_P(HardwareCulling, tests_again_what_was_found_together_with_what_may_hide_it) {
  size_t more = 0;
  for (size_t frame = 0; frame < views.size(); ++frame) {
    const size_t without_test = untestable(frame).size();
    max_found = SIZE_MAX;
    HiddenByTheFirst all;
    const size_t at_once = cull(frame, all).visible.size();
    for (const size_t few : {size_t{0}, size_t{1}, size_t{3}}) {
      max_found = few;
      HiddenByTheFirst tester;
      const size_t found = cull(frame, tester).visible.size();
      EXPECT_LE(found, without_test + std::max<size_t>(few, 1)) << "frame " << frame;
      EXPECT_LE(found, at_once) << "frame " << frame;
      more += at_once - found;
    }
  }
  if (skeleton.drawables.size() > 100) {
    EXPECT_GT(more, 0u) << "nothing was found together";
  }
}

TEST_P(HardwareCulling, draws_only_what_it_found_visible_and_what_is_not_represented_yet) {
  VisibleSet previous;
  for (size_t frame = 0; frame < views.size(); ++frame) {
    FakeTester tester(some);
    const std::vector<DrawableId> drawn = represented(frame, previous);
    const std::set<DrawableId> there(drawn.begin(), drawn.end());
    const CullResult result = cull(frame, tester, previous, 5);
    std::set<DrawableId> once;
    for (const DrawableId id : tester.drawn) {
      EXPECT_TRUE(once.insert(id).second) << "drawn twice";
      EXPECT_FALSE(there.count(id)) << "is in the representation already";
      EXPECT_TRUE(std::binary_search(result.visible.begin(), result.visible.end(), id)) << "is not visible";
    }
    previous = result.visible;
  }
}

using Sides = std::array<float, 4>;
Sides sides_of(const ScreenRectangle& r) { return {r.left, r.bottom, r.right, r.top}; }

TEST_P(HardwareCulling, loses_nothing_of_which_only_the_smallest_piece_shows) {
  for (size_t frame = 0; frame < views.size(); ++frame) {
    const BoxProjector projector(view_of(frame));
    std::set<Sides> showing;
    for (const DrawableId id : cut_of(frame).drawables) {
      for (const ScreenRectangle& placed : placement_bounds(hierarchy, projector, id).rectangles)
        showing.insert(sides_of(placed));
      const auto pieces = drawable_bounds(hierarchy, projector, id).rectangles;
      if (pieces.empty()) continue;
      showing.insert(
          sides_of(*std::min_element(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) {
            return (a.right - a.left) * (a.top - a.bottom) < (b.right - b.left) * (b.top - b.bottom);
          })));
    }
    for (const SceneNode& node : skeleton.scene_nodes)
      showing.insert(sides_of(projector.bounds(node.box).rectangle));
    for (const VisibleSet& previous : {VisibleSet(), on_screen(frame)}) {
      FakeTester tester([&](const ScreenRectangle& r) { return showing.count(sides_of(r)) > 0; });
      EXPECT_EQ(cull(frame, tester, previous).visible, on_screen(frame)) << "frame " << frame;
    }
  }
}

TEST_P(HardwareCulling, tests_the_two_largest_of_many_pieces_where_one_of_them_shows) {
  max_found = SIZE_MAX;  // or some would be tested again
  for (size_t frame = 0; frame < views.size(); ++frame) {
    const BoxProjector projector(view_of(frame));
    std::vector<size_t> expected;
    for (const DrawableId id : on_screen(frame)) {
      const size_t boxes = drawable_bounds(hierarchy, projector, id).rectangles.size();
      expected.push_back(has_pieces(hierarchy, id) && boxes > 4 ? 2 : boxes);
    }
    FakeTester tester(always);
    cull(frame, tester, on_screen(frame));
    // Inner scene nodes without any content on the screen may be tested as well, by a box each.
    for (std::vector<size_t>* boxes : {&expected, &tester.boxes}) {
      boxes->erase(std::remove_if(boxes->begin(), boxes->end(), [](size_t count) { return count < 2; }),
                   boxes->end());
      std::sort(boxes->begin(), boxes->end());
    }
    EXPECT_EQ(tester.boxes, expected) << "frame " << frame;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, HardwareCulling, testing::ValuesIn(scenes::names()),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace triptych
