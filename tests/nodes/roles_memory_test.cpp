// Three roles within caps of memory: pictures stay right, or say at which pixel error they are.
#include "base/error.hpp"
#include "tests/nodes/roles_rig.hpp"

namespace triptych::test {
namespace {

class RolesWithinCaps : public Roles {
 protected:
  static constexpr uint64_t plenty = 64 << 20;

  /// What frames take at the path's pixel error, at most.
  static uint64_t largest_view() {
    static const uint64_t largest =
        thread(Role::render)
            .run([] {
              LocalPipeline pipeline(
                  pack(),
                  {.width = side, .height = side, .cull = StrategyKind::frustum, .device = wanted_device()});
              uint64_t most = 0;
              for (uint32_t i = 0; i < views().size(); ++i) {
                pipeline.draw({i, {views()[i], 1}});
                most = std::max(most, pipeline.device().geometry_use().view_bytes);
              }
              return most;
            })
            .get();
    return largest;
  }
  /// The whole cut of a frame, drawn in one process with all of the memory.
  static uint64_t whole_cut(const FrameRecord& record, FrameState state) {
    return thread(Role::render)
        .run([&] {
          static LocalPipeline pipeline(
              pack(),
              {.width = side, .height = side, .cull = StrategyKind::frustum, .device = wanted_device()});
          state.view = views()[record.number % views().size()];
          state.pixel_error = record.pixel_error;
          pipeline.draw({record.number, state});
          const auto colors = pipeline.target().read_colors();
          return hash_values(std::span<const uint8_t>(colors));
        })
        .get();
  }
};

TEST_F(RolesWithinCaps, draw_the_same_pictures_where_there_is_room) {
  caps = {.device_memory = plenty};
  const RenderNodeSummary summary = run_all(24);
  expect_right_pictures(24);
  EXPECT_EQ(summary.fallback_frames, 0u);
  EXPECT_EQ(mismatches(), 0u);
  EXPECT_GT(summary.memory.geometry.loaded_chunks, 0u);
  EXPECT_GT(summary.memory.read_ahead.taken, 0u) << "nothing was read ahead";
  for (const FrameRecord& record : pictures.records) EXPECT_FALSE(record.raised_for_memory) << record.number;
}

TEST_F(RolesWithinCaps, raise_the_pixel_error_where_there_is_none_and_say_so) {
  caps = {.device_memory = plenty};
  const uint64_t cap = largest_view() * 2 / 5;
  pictures.on_show = [&](LocalPipeline& stages) { stages.device().set_geometry_cap(cap); };
  const RenderNodeSummary summary = run_all(48);
  ASSERT_EQ(pictures.records.size(), 48u);
  EXPECT_EQ(summary.fallback_frames, 0u);
  EXPECT_EQ(mismatches(), 0u);
  size_t raised = 0, redrawn = 0;
  for (const FrameRecord& record : pictures.records) {
    raised += record.raised_for_memory;
    redrawn += record.redrawn;
    EXPECT_EQ(record.raised_for_memory, record.pixel_error > 1) << record.number;
    EXPECT_EQ(record.picture_hash, whole_cut(record, like)) << record.number << ": " << record.pixel_error;
  }
  EXPECT_GT(raised, 0u);
  EXPECT_GT(redrawn, 0u) << "no frame had been sent with too small an error";
  EXPECT_LT(redrawn, raised) << "the raised error is not sent with the camera";
}

TEST_F(RolesWithinCaps, say_what_they_owe_where_they_do_not_wait) {
  caps = {.on_miss = OnMiss::coarser};
  pictures.after = [](uint32_t) { std::this_thread::sleep_for(std::chrono::milliseconds(2)); };
  const RenderNodeSummary summary = run_all(72);
  ASSERT_EQ(pictures.records.size(), 72u);
  EXPECT_EQ(summary.fallback_frames, 0u);
  EXPECT_EQ(mismatches(), 0u);
  size_t whole = 0;
  for (const FrameRecord& record : pictures.records) {
    if (record.owed_drawables > 0) continue;
    ++whole;
    EXPECT_EQ(record.picture_hash, right()[record.number % right().size()]) << record.number;
  }
  EXPECT_GT(whole, 0u);
}

TEST_F(RolesWithinCaps, go_on_without_what_no_pixel_error_gives_room_or_end_with_what_would) {
  caps = {.device_memory = plenty};
  const auto run = [&](MemoryKeeper::NoPixelError otherwise) {
    no_pixel_error = otherwise;
    pictures.records.clear();
    pictures.on_show = [](LocalPipeline& stages) { stages.device().set_geometry_cap(1000); };
    return run_all(12);
  };
  EXPECT_EQ(run(MemoryKeeper::NoPixelError::leaves_out).frames, 12u);
  ASSERT_EQ(pictures.records.size(), 12u);
  EXPECT_GT(pictures.records.back().left_out_drawables, 0u);
  EXPECT_EQ(mismatches(), 0u);
  try {
    run(MemoryKeeper::NoPixelError::fails);
    FAIL() << "it went on";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("at any pixel error"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace triptych::test
