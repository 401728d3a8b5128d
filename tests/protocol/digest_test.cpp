#include "protocol/digest.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

TEST(FrameDigest, the_same_frame_has_the_same_digest) {
  const View view{{{1, 2, 3}, {4, 5, 6}, {0, 0, 1}, -1, 1, -1, 1, 0.1}, 512, 512};
  EXPECT_EQ(frame_digest(7, {view, 1.0}, 99, {1, 2, 3}), frame_digest(7, {view, 1.0}, 99, {1, 2, 3}));
}

TEST(FrameDigest, whatever_makes_a_frame_changes_it) {
  const View view{{{1, 2, 3}, {4, 5, 6}, {0, 0, 1}, -1, 1, -1, 1, 0.1}, 512, 512};
  const uint64_t digest = frame_digest(7, {view, 1.0}, 99, {1, 2, 3});
  EXPECT_NE(frame_digest(8, {view, 1.0}, 99, {1, 2, 3}), digest);
  EXPECT_NE(frame_digest(7, {view, 2.0}, 99, {1, 2, 3}), digest);
  EXPECT_NE(frame_digest(7, {view, 1.0, 4}, 99, {1, 2, 3}), digest);
  EXPECT_NE(frame_digest(7, {view, 1.0, 1, true}, 99, {1, 2, 3}), digest);
  EXPECT_NE(frame_digest(7, {view, 1.0}, 98, {1, 2, 3}), digest);
  for (const Sky& sky : {Sky{true, {0, 1, 0}}, Sky{true, {0, 0.6, 0.8}}})
    EXPECT_NE(frame_digest(7, {.view = view, .sky = sky}, 99, {1, 2, 3}), digest);
  EXPECT_NE(frame_digest(7, {view, 1.0}, 99, {1, 2}), digest);
  EXPECT_NE(frame_digest(7, {view, 1.0}, 99, {1, 2, 4}), digest);
  EXPECT_NE(frame_digest(7, {view, 1.0}, 99, {}), digest);
  Section plane, box;
  plane.add_plane({{0, 0, 1}, 2}, "test");
  box.set_box({{0, 0, 0}, {1, 1, 1}}, "test");
  EXPECT_NE(frame_digest(7, {view, 1.0, 1, false, plane}, 99, {1, 2, 3}), digest);
  EXPECT_NE(frame_digest(7, {view, 1.0, 1, false, box}, 99, {1, 2, 3}), digest);
  EXPECT_NE(frame_digest(7, {view, 1.0, 1, false, {}, {{1, 5}}}, 99, {1, 2, 3}), digest);
  EXPECT_NE(frame_digest(7, {view, 1.0, 1, false, {}, {{1, 5}}}, 99, {1, 2, 3}),
            frame_digest(7, {view, 1.0, 1, false, {}, {{1, 6}}}, 99, {1, 2, 3}));
  EXPECT_NE(frame_digest(7, {view, 1.0, 1, false, {}, {}, Effects::all(), 0.5}, 99, {1, 2, 3}), digest);
  EXPECT_EQ(frame_digest(7, {view, 1.0, 1, false, {}, {}, Effects::all(), -0.0}, 99, {1, 2, 3}), digest);
  for (int field = 0; field < 8; ++field) {
    View other = view;
    if (field == 0) other.camera.eye.x = 1.0000000000000002;
    if (field == 1) other.camera.target.z += 1;
    if (field == 2) other.camera.up.y = 1;
    if (field == 3) other.camera.left = -2;
    if (field == 4) other.camera.near = 0.2;
    if (field == 5) other.width = 513;
    if (field == 6) other.height = 511;
    if (field == 7) other.camera.projection = Projection::orthographic;
    EXPECT_NE(frame_digest(7, {other, 1.0}, 99, {1, 2, 3}), digest) << field;
  }
}

}  // namespace
}  // namespace triptych
