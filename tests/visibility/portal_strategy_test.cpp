// What shows through portals is in the set, and what walls close off is not.
#include "visibility/portal_strategy.hpp"

#include "cells/make_cells.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace triptych {
namespace {

/// Draws and tests nothing: the strategy asks for neither.
class NoTarget final : public FrameTarget {
 public:
  int width() const override { return 64; }
  int height() const override { return 48; }
  TargetKind kind() const override { return TargetKind::depth_only; }
  void begin(const FrameView&) override { FAIL(); }
  void draw(std::span<const DrawableId>) override { FAIL(); }
  void test(std::span<const ScreenRectangle>, std::span<const uint32_t>, uint32_t,
            std::span<uint8_t>) override {
    FAIL();
  }
  void finish() override {}
  uint64_t drawn_triangles() const override { return 0; }
  void draw_lines(std::span<const ScreenLine>) override {}
  std::vector<uint8_t> read_colors() const override { return {}; }
  std::vector<uint32_t> read_items(uint32_t) const override { return {}; }
  bool copy_to_window(int, int) const override { return false; }
};

struct Portals : testing::Test {
  const Pack& pack = scenes::pack("room");
  PortalStrategy strategy{std::make_shared<const CellGraph>(make_cells(pack))};
  NoTarget target;
  NoSink sink;

  VisibleSet seen(const FrameState& state) {
    return strategy.run(FrameView(pack.skeleton(), state), {}, target, sink).visible;
  }
  VisibleSet cut(const FrameState& state) const {
    VisibleSet all = select_cut(FrameView(pack.skeleton(), state)).drawables;
    std::sort(all.begin(), all.end());
    return all;
  }
};

TEST_F(Portals, leave_out_some_of_the_cut_and_add_nothing_to_it) {
  size_t left_out = 0;
  for (const View& view : scenes::path(pack.skeleton(), 64, 48)) {
    const FrameState state{view, 1};
    const VisibleSet all = cut(state), some = seen(state);
    EXPECT_TRUE(std::includes(all.begin(), all.end(), some.begin(), some.end()));
    left_out += all.size() - some.size();
  }
  EXPECT_GT(left_out, 0u);
}

TEST_F(Portals, take_the_whole_cut_of_what_they_do_not_apply_to) {
  std::vector<View> views = scenes::path(pack.skeleton(), 64, 48);
  FrameState state{views.front(), 1};
  const size_t through = seen(state).size();
  state.section.add_plane({{0, 0, 1}, -1e6}, "test");
  EXPECT_EQ(seen(state), cut(state)) << "a section";
  EXPECT_LE(through, cut(state).size());
  state.section = {};
  set_orthographic_height(state.view.camera, 4, 64.0 / 48);
  EXPECT_EQ(seen(state), cut(state)) << "an orthographic view";
}

TEST_F(Portals, tell_the_delta_to_the_set_before) {
  const std::vector<View> views = scenes::path(pack.skeleton(), 64, 48);
  struct Kept final : CullSink {
    void take(const CullPacket& packet) override { packets.push_back(packet); }
    std::vector<CullPacket> packets;
  } kept;
  const VisibleSet before = seen({views[0], 1});
  const VisibleSet after =
      strategy.run(FrameView(pack.skeleton(), {views[5], 1}), before, target, kept).visible;
  ASSERT_EQ(kept.packets.size(), 1u);
  EXPECT_EQ(kept.packets[0].watermark, everything_decided);
  const VisibleDelta expected = difference(before, after);
  EXPECT_EQ(kept.packets[0].delta.added, expected.added);
  EXPECT_EQ(kept.packets[0].delta.removed, expected.removed);
}

}  // namespace
}  // namespace triptych
