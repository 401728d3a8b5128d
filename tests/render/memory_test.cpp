// Drawing within caps of memory: the same pictures where there is room, coarser ones where there is not.
#include "base/error.hpp"
#include "lod/cut.hpp"
#include "nodes/local_pipeline.hpp"
#include "render/gl/device_space.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/test_device.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <thread>
#include <unistd.h>

namespace triptych {
namespace {

constexpr int width = 96, height = 80;

/// The chunk's bytes are not what they were.
void damage(const std::filesystem::path& file, const ChunkInfo& chunk) {
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekp(static_cast<std::streamoff>(32 + chunk.offset + chunk.size / 2));
  bytes.put('\x5a').put('\x5a').put('\x5a').put('\x5a');
}

class CappedPictures : public testing::Test {
 protected:
  const Pack& pack = scenes::pack("room");

  std::vector<FrameRequest> frames(size_t count) const {
    std::vector<FrameRequest> frames;
    const std::vector<View> views = scenes::path(pack.skeleton(), width, height);
    for (size_t i = 0; i < std::min(count, views.size()); ++i)
      frames.push_back({static_cast<uint32_t>(i), {views[i], 1}});
    return frames;
  }
  std::unique_ptr<LocalPipeline> pipeline(const MemoryCaps& caps = {}) const {
    DeviceOptions device = test::device();
    device.memory = caps;
    return std::make_unique<LocalPipeline>(
        pack, LocalPipelineOptions{.width = width, .height = height, .device = device});
  }
};

TEST_F(CappedPictures, are_the_same_where_each_frame_has_room_and_chunks_come_and_go) {
  const std::vector<FrameRequest> path = frames(60);
  const auto whole = pipeline();
  uint64_t largest = 0;
  std::vector<std::vector<uint8_t>> pictures;
  for (const FrameRequest& frame : path) {
    whole->draw(frame);
    pictures.push_back(whole->target().read_colors());
    largest = std::max(largest, whole->device().geometry_use().view_bytes);
  }
  const GeometryUse all = whole->device().geometry_use();
  EXPECT_EQ(all.evicted_chunks, 0u);
  // Gaps of the buffer on gl, and what a chunk is thought to take before it is read, need some more.
  const uint64_t cap = largest + largest / 4;
  ASSERT_GT(all.bytes, cap) << "no frame shows all of the model";
  const auto capped = pipeline({.device_memory = 64 << 20});
  capped->draw(path[0]);  // which sets the cap that was asked for
  capped->device().set_geometry_cap(cap);
  for (size_t i = 0; i < path.size(); ++i) {
    const FrameRecord& record = capped->draw(path[i]);
    ASSERT_FALSE(record.raised_for_memory) << i;
    ASSERT_EQ(capped->target().read_colors(), pictures[i]) << i;
  }
  const GeometryUse use = capped->device().geometry_use();
  EXPECT_GT(use.evicted_chunks, 0u);
  EXPECT_GT(use.reloaded_chunks, 0u);
  EXPECT_LE(use.peak_bytes, use.cap);
}

TEST_F(CappedPictures, are_coarser_where_a_frame_has_no_room_and_say_so) {
  const std::vector<FrameRequest> path = frames(30);
  const auto whole = pipeline();
  uint64_t largest = 0, least = no_cap;
  for (const FrameRequest& frame : path) {
    whole->draw(frame);
    largest = std::max(largest, whole->device().geometry_use().view_bytes);
    FrameRequest coarse = frame;
    coarse.state.pixel_error = 4096;
    whole->draw(coarse);
    least = std::min(least, whole->device().geometry_use().view_bytes);
  }
  auto capped = pipeline({.device_memory = 64 << 20});
  capped->draw(path[0]);  // which sets the cap that was asked for
  capped->device().set_geometry_cap(largest / 2);
  size_t raised = 0;
  whole->forget();
  for (const FrameRequest& frame : path) {
    FrameRequest drawn = frame;
    try {
      drawn.state.pixel_error = capped->draw(frame).pixel_error;
    } catch (const Error& error) {
      // The same frame at the largest error does take more.
      EXPECT_NE(std::string(error.what()).find("at any pixel error"), std::string::npos) << error.what();
      continue;
    }
    EXPECT_LE(capped->device().geometry_use().bytes, largest / 2);
    raised += drawn.state.pixel_error > frame.state.pixel_error;
    whole->draw(drawn);
    ASSERT_EQ(capped->target().read_colors(), whole->target().read_colors()) << frame.number;
  }
  EXPECT_GT(raised, 0u);
  EXPECT_GT(least, 0u);
}

TEST_F(CappedPictures, a_cap_that_cannot_work_is_refused_with_what_would) {
  const auto message = [&](const MemoryCaps& caps) {
    try {
      const auto refused = pipeline(caps);
      for (const FrameRequest& frame : frames(3)) refused->draw(frame);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string process = message({.memory = 1 << 20});
  EXPECT_EQ(process.find("--memory: 1 MiB, but"), 0u) << process;
  EXPECT_NE(process.find("MiB are needed"), std::string::npos) << process;
  const std::string device = message({.device_memory = 1000});
  EXPECT_EQ(device.find("--device-memory: "), 0u) << device;
  EXPECT_NE(device.find("at least"), std::string::npos) << device;
}

TEST_F(CappedPictures, a_cap_may_change_while_frames_are_drawn) {
  const std::vector<FrameRequest> path = frames(40);
  const auto whole = pipeline(), capped = pipeline({.device_memory = 64 << 20});
  uint64_t largest = 0;
  for (const FrameRequest& frame : path) {
    whole->draw(frame);
    largest = std::max(largest, whole->device().geometry_use().view_bytes);
  }
  whole->forget();
  const uint64_t caps[] = {2 * largest, largest + largest / 3, 8 * largest};
  capped->draw(path[0]);  // which sets the cap that was asked for
  capped->forget();
  for (size_t i = 0; i < path.size(); ++i) {
    if (i % 5 == 0) capped->device().set_geometry_cap(caps[i / 5 % 3]);
    FrameRequest drawn = path[i];
    drawn.state.pixel_error = capped->draw(path[i]).pixel_error;
    whole->draw(drawn);
    ASSERT_EQ(capped->target().read_colors(), whole->target().read_colors()) << i;
    EXPECT_LE(capped->device().geometry_use().bytes, caps[i / 5 % 3]) << i;
  }
}

TEST_F(CappedPictures, that_do_not_wait_become_the_exact_ones_while_the_camera_rests) {
  const std::vector<FrameRequest> path = frames(12);
  const auto whole = pipeline(), hasty = pipeline({.on_miss = OnMiss::coarser});
  for (const FrameRequest& frame : path) {
    whole->draw(frame);
    for (size_t tries = 0; hasty->draw(frame).owed_drawables > 0; ++tries) {
      ASSERT_LT(tries, 20'000u) << frame.number;
      EXPECT_GT(hasty->target().drawn_triangles(), 0u);
      std::this_thread::yield();
    }
    EXPECT_FALSE(hasty->draw(frame).gets_finer) << frame.number;
    ASSERT_EQ(hasty->target().read_colors(), whole->target().read_colors()) << frame.number;
  }
}

TEST_F(CappedPictures, what_is_drawn_between_frames_does_without_what_has_no_room) {
  const std::vector<FrameRequest> path = frames(12);
  for (const OnMiss on_miss : {OnMiss::exact, OnMiss::coarser}) {
    const auto whole = pipeline(), capped = pipeline({.device_memory = 64 << 20, .on_miss = on_miss});
    const auto between = capped->device().make_target(TargetKind::item, width, height);
    for (const FrameRequest& frame : path) {
      FrameRequest drawn = frame;
      for (size_t tries = 0; capped->draw(frame).owed_drawables > 0; ++tries) {
        ASSERT_LT(tries, 20'000u);
        std::this_thread::yield();
      }
      drawn.state.pixel_error = capped->draw(frame).pixel_error;
      whole->draw(drawn);
      ASSERT_EQ(capped->target().read_colors(), whole->target().read_colors()) << frame.number;
      capped->device().set_geometry_cap(1000);  // less than anything takes
      const FrameView outside(pack.skeleton(), {path[(frame.number + 5) % path.size()].state.view, 0});
      between->begin(outside);
      EXPECT_NO_THROW(between->draw(select_cut(outside).drawables));
      between->finish();
      EXPECT_GT(capped->device().geometry_use().no_room, 0u);
      capped->device().set_geometry_cap(64 << 20);
    }
  }
}

TEST_F(CappedPictures, leave_out_what_no_pixel_error_gives_room_where_they_are_to_go_on) {
  const std::vector<FrameRequest> path = frames(12);
  const auto whole = pipeline();
  DeviceOptions device = test::device();
  for (const OnMiss on_miss : {OnMiss::exact, OnMiss::coarser}) {
    device.memory = {.device_memory = 64 << 20, .on_miss = on_miss};
    LocalPipeline capped(pack, {.width = width,
                                .height = height,
                                .device = device,
                                .no_pixel_error = MemoryKeeper::NoPixelError::leaves_out});
    for (const FrameRequest& frame : path) {
      for (size_t tries = 0; capped.draw(frame).gets_finer; ++tries) {
        ASSERT_LT(tries, 20'000u);
        std::this_thread::yield();
      }
      EXPECT_EQ(capped.draw(frame).left_out_drawables, 0u);
      capped.device().set_geometry_cap(1000);  // less than anything takes
      const FrameRecord& starved = capped.draw(frame);
      EXPECT_GT(starved.left_out_drawables, 0u) << frame.number;
      EXPECT_LE(starved.left_out_drawables, starved.visible_count);
      EXPECT_TRUE(starved.raised_for_memory);
      EXPECT_FALSE(starved.gets_finer) << "a window would draw it over and over";
      EXPECT_LE(capped.device().geometry_use().bytes, 1000u);
      capped.device().set_geometry_cap(64 << 20);
      size_t more = 0;
      while (capped.draw(frame).gets_finer) ASSERT_LT(++more, 20'000u);
      whole->draw(frame);
      ASSERT_EQ(capped.target().read_colors(), whole->target().read_colors()) << frame.number;
    }
  }
}

TEST(DamagedChunks, that_nothing_coarser_stands_in_for_are_left_out_where_frames_do_not_wait) {
  const std::filesystem::path file =
      testing::TempDir() + "triptych_damaged_root_" + std::to_string(::getpid()) + ".tpk";
  scenes::write_pack("room", file);
  const Pack pack(file);
  const Skeleton& skeleton = pack.skeleton();
  FrameRequest frame{0, {scenes::path(skeleton, width, height).front(), 4096}};
  const std::vector<DrawableId> cut = select_cut(FrameView(skeleton, frame.state)).drawables;
  ASSERT_FALSE(cut.empty());
  std::set<uint32_t> chunks;
  for (const DrawableId id : cut) {
    const Drawable& drawable = skeleton.drawables[id];
    for (uint32_t i = 0; i < drawable.placement_count; ++i)
      chunks.insert(skeleton.placements[drawable.first_placement + i].chunk);
  }
  for (const uint32_t chunk : chunks) damage(file, skeleton.chunks[chunk]);
  DeviceOptions device = test::device();
  device.memory.on_miss = OnMiss::coarser;
  LocalPipeline hasty(pack, {.width = width, .height = height, .cull = StrategyKind::none, .device = device});
  for (size_t tries = 0; hasty.draw(frame).gets_finer; ++tries) {
    ASSERT_LT(tries, 20'000u);
    std::this_thread::yield();
  }
  EXPECT_GT(hasty.draw(frame).owed_drawables, 0u);
  std::filesystem::remove(file);
}

/// Of the first chunk of so many levels of a leaf, from the finest on.
void expect_damage_to_be_survived(uint32_t levels) {
  const std::filesystem::path file =
      testing::TempDir() + "triptych_damaged_chunks_" + std::to_string(::getpid()) + ".tpk";
  scenes::write_pack("room", file);
  const Pack pack(file);
  // The finest drawable of a leaf that has coarser ones.
  const Skeleton& skeleton = pack.skeleton();
  const auto leaf =
      std::find_if(skeleton.scene_nodes.begin(), skeleton.scene_nodes.end(),
                   [](const SceneNode& node) { return node.child_count == 0 && node.drawable_count > 1; });
  ASSERT_NE(leaf, skeleton.scene_nodes.end());
  for (uint32_t level = 0; level < levels; ++level) {
    const Drawable& drawable = skeleton.drawables[leaf->first_drawable + level];
    const uint32_t chunk = skeleton.placements[drawable.first_placement].chunk;
    damage(file, skeleton.chunks[chunk]);
    EXPECT_THROW(pack.read_chunk(chunk), Error);
  }
  const Box box = skeleton.lattice().box(leaf->box);
  FrameRequest frame{0, {scenes::path(skeleton, width, height).front(), 0}};
  Camera& camera = frame.state.view.camera;
  camera.target = (box.lo + box.hi) * 0.5;
  camera.eye = camera.target + glm::dvec3(0.3, 0.4, 1) * (2 * glm::length(box.hi - box.lo));
  const auto pipeline = [&](OnMiss on_miss) {
    DeviceOptions device = test::device();
    device.memory.on_miss = on_miss;
    return std::make_unique<LocalPipeline>(
        pack, LocalPipelineOptions{
                  .width = width, .height = height, .cull = StrategyKind::frustum, .device = device});
  };
  EXPECT_THROW(pipeline(OnMiss::exact)->draw(frame), Error);
  const auto hasty = pipeline(OnMiss::coarser);
  hasty->draw(frame);
  for (size_t tries = 0; hasty->draw(frame).gets_finer; ++tries) {
    ASSERT_LT(tries, 20'000u);
    std::this_thread::yield();
  }
  EXPECT_EQ(hasty->draw(frame).owed_drawables, 1u) << "and nothing else is awaited";
  std::filesystem::remove(file);
}

TEST(DamagedChunks, are_an_error_where_frames_wait_and_stay_coarser_where_they_do_not) {
  expect_damage_to_be_survived(1);
}

TEST(DamagedChunks, of_the_next_coarser_level_too_are_not_awaited_over_and_over) {
  expect_damage_to_be_survived(2);
}

TEST(DeviceSpace, gives_each_byte_to_one_and_joins_what_comes_back) {
  DeviceSpace space;
  EXPECT_FALSE(space.take(1, 1).has_value());
  space.grow(1000);
  space.grow(4096);
  std::mt19937 random(1);
  std::vector<std::pair<uint64_t, uint64_t>> taken;
  std::vector<uint8_t> owned(4096, 0);
  for (size_t round = 0; round < 20'000; ++round) {
    if (random() % 2 == 0 || taken.empty()) {
      const uint64_t bytes = 1 + random() % 200, alignment = std::array{1, 4, 16, 20}[random() % 4];
      const auto offset = space.take(bytes, alignment);
      if (!offset) continue;
      ASSERT_EQ(*offset % alignment, 0u);
      ASSERT_LE(*offset + bytes, 4096u);
      for (uint64_t i = *offset; i < *offset + bytes; ++i) ASSERT_EQ(owned[i]++, 0) << round;
      taken.emplace_back(*offset, bytes);
    } else {
      const size_t which = random() % taken.size();
      const auto [offset, bytes] = taken[which];
      taken[which] = taken.back();
      taken.pop_back();
      for (uint64_t i = offset; i < offset + bytes; ++i) --owned[i];
      space.give_back(offset, bytes);
    }
  }
  for (const auto& [offset, bytes] : taken) space.give_back(offset, bytes);
  EXPECT_EQ(space.take(4096, 20), std::optional<uint64_t>(0)) << "all of it is one gap again";
}

}  // namespace
}  // namespace triptych
