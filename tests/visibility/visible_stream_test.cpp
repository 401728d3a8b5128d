// A receiver's view of a frame: each drawable of V(i) once, in draw rank order, as soon as it is decided.
#include "visibility/visible_stream.hpp"

#include "tests/support/scenes.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace triptych {
namespace {

class Stream : public testing::Test {
 protected:
  const Skeleton& skeleton = scenes::pack("room").skeleton();
  scenes::Random random{31};
  View view;
  glm::ivec3 cell{0};
  VisibleSet previous, next;
  std::vector<CullPacket> packets;

  VisibleSet some_set() {
    const double share = random.number();
    VisibleSet set;
    for (DrawableId id = 0; id < skeleton.drawables.size(); ++id) {
      if (random.number() < share) set.push_back(id);
    }
    return set;
  }

  /// V(i−1) → V(i) in packets cut anywhere; what is added may come earlier than it is decided.
  void make_frame() {
    view = scenes::random_views(skeleton, 64, 64, 1, random.index(1000)).front();
    cell = eye_cell(skeleton, view);
    previous = some_set();
    next = some_set();
    const VisibleDelta delta = difference(previous, next);
    std::vector<DrawRank> watermarks = {{~uint64_t{0}, no_id}};
    for (uint32_t count = random.index(8); count > 0; --count) {
      const DrawRank rank = draw_rank(skeleton, cell, random.index(skeleton.drawables.size()));
      watermarks.push_back({rank.distance, random.index(2) ? rank.id : 0});
    }
    std::sort(watermarks.begin(), watermarks.end());
    packets.assign(watermarks.size(), {});
    for (size_t i = 0; i < packets.size(); ++i) packets[i].watermark = watermarks[i];
    const auto decided_in = [&](DrawableId id) {
      return static_cast<size_t>(
          std::upper_bound(watermarks.begin(), watermarks.end(), draw_rank(skeleton, cell, id)) -
          watermarks.begin());
    };
    for (const DrawableId id : delta.added)
      packets[random.index(decided_in(id) + 1)].delta.added.push_back(id);
    for (const DrawableId id : delta.removed) packets[decided_in(id)].delta.removed.push_back(id);
  }
};

TEST_F(Stream, gives_each_drawable_once_in_draw_rank_order) {
  for (int round = 0; round < 200; ++round) {
    make_frame();
    VisibleStream stream(skeleton, {view}, previous);
    std::vector<DrawableId> decided;
    for (const CullPacket& packet : packets) {
      for (const DrawableId id : stream.take(packet)) {
        EXPECT_LT(draw_rank(skeleton, cell, id), packet.watermark);
        decided.push_back(id);
      }
      const auto below = std::count_if(next.begin(), next.end(), [&](DrawableId id) {
        return draw_rank(skeleton, cell, id) < packet.watermark;
      });
      EXPECT_EQ(static_cast<size_t>(below), decided.size()) << "all that is decided, at once";
    }
    std::vector<DrawableId> expected = next;
    sort_by_rank(skeleton, cell, expected);
    EXPECT_EQ(decided, expected);
    EXPECT_EQ(stream.visible(), next);
    EXPECT_EQ(stream.faults(), 0u);
  }
}

TEST_F(Stream, counts_ids_that_the_sender_cannot_mean) {
  const VisibleSet before = {2, 4, 6};
  const auto beyond = static_cast<DrawableId>(skeleton.drawables.size());
  const std::vector<VisibleDelta> wrong = {{{4}, {}},     {{}, {5}},      {{beyond}, {}},
                                           {{no_id}, {}}, {{}, {beyond}}, {{5, 3}, {}}};
  for (const VisibleDelta& delta : wrong) {
    VisibleStream stream(skeleton, {view}, before);
    const std::vector<DrawableId> decided = stream.take({{~uint64_t{0}, no_id}, delta});
    EXPECT_GT(stream.faults(), 0u);
    EXPECT_EQ(stream.visible(), before);
    EXPECT_EQ(decided.size(), before.size());
  }
}

}  // namespace
}  // namespace triptych
