// The bits of the pictures, pinned: the same on every processor and with every library. CMake runs it a
// second time with the C library's functions for processors without fused multiply-add.
#include "base/hashing.hpp"
#include "base/threads.hpp"
#include "lod/cut.hpp"
#include "raster/instruction_set.hpp"
#include "raster/raster_device.hpp"
#include "residency/load_on_demand.hpp"
#include "scene/finest_boxes.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>
#include <map>

namespace triptych {
namespace {

/// Looks at the middle of the model from somewhere in its box, made twice as large. No function of the C
/// library that rounds differently somewhere takes part.
View view_from_anywhere(const Skeleton& skeleton, scenes::Random& random, int width, int height) {
  const Box box = model_box(skeleton);
  const glm::dvec3 middle = (box.lo + box.hi) * 0.5;
  View view{.camera = {.eye = middle + (box.hi - box.lo) * random.vector(-1, 1),
                       .target = middle,
                       .near = skeleton.default_near()},
            .width = width,
            .height = height};
  set_field_of_view(view.camera, random.number(20, 110), static_cast<double>(width) / height);
  return view;
}

/// Of colours and items of a dozen frames, of so many samples.
uint64_t checksum_of_pictures(const Pack& pack, uint32_t samples = 1, bool edges = false) {
  constexpr int width = 200, height = 150;
  const Skeleton& skeleton = pack.skeleton();
  const Hierarchy hierarchy(skeleton);
  LevelsRepresentation representation(hierarchy);
  LoadOnDemand residency(pack);
  const auto device = make_raster_device(skeleton, representation, residency, {});
  const auto target = device->make_target(TargetKind::color_and_item, width, height);
  scenes::Random random(1);
  StreamHash hash;
  for (int frame = 0; frame < 12; ++frame) {
    const FrameView view(skeleton, {view_from_anywhere(skeleton, random, width, height), 1, samples, edges});
    std::vector<DrawableId> cut = select_cut(view).drawables;
    sort_by_rank(skeleton, view.cell, cut);
    target->begin(view);
    target->draw(cut);
    target->finish();
    const auto colors = target->read_colors();
    const auto items = target->read_items();
    hash.add(std::as_bytes(std::span(colors)));
    hash.add(std::as_bytes(std::span(items)));
  }
  return hash.checksum();
}

TEST(PinnedPictures, are_the_same_bits_on_every_processor_and_with_any_number_of_threads) {
  // Where a change of the device or of the packs is meant to change pictures, these change with it.
  const std::map<std::string, uint64_t> pinned = {
      {"room", 0x85637b66d574a65c},      {"flat", 0x1203200a3ada6cde},     {"coplanar", 0x0acd78cd0940f899},
      {"slivers", 0xb6fc6cf30f326652},   {"dust", 0xd8c5ca9245e01fca},     {"world", 0x8bc3b1d8ffe64faf},
      {"instances", 0x8518df21fc7fbfe9}, {"sheared", 0x16336822280ba212},  {"far", 0x85637b66d574a65c},
      {"storeys", 0x7c3d94ba16fcd227},   {"painted", 0x671a4c0b82bd7d57},  {"triangle", 0x967ae65c48329f7c},
      {"glass", 0xe49002c48ccf38e4},     {"textured", 0x55e242781b053d93}, {"smooth", 0x847c8880ac7ca9a2},
  };
  for (const auto& [name, expected] : pinned) {
    for (const InstructionSet set : instruction_sets_here()) {
      for (const unsigned threads : {1u, 3u}) {
        force_instruction_set(set);
        set_thread_count(threads);
        EXPECT_EQ(checksum_of_pictures(scenes::pack(name)), expected)
            << name << ", " << instruction_set_name(set) << ", " << threads << " threads";
      }
    }
  }
  set_thread_count(0);
  force_instruction_set(std::nullopt);
  EXPECT_EQ(pinned.size(), scenes::names().size());
}

TEST(PinnedPictures, of_several_samples_and_with_edges_are_too) {
  const std::map<std::string, uint64_t> pinned = {
      {"room", 0x7c31e9f51e83f4f4}, {"coplanar", 0xedec8bece0bca284}, {"painted", 0xf0748d011673eb1a}};
  for (const auto& [name, expected] : pinned) {
    for (const InstructionSet set : instruction_sets_here()) {
      force_instruction_set(set);
      EXPECT_EQ(checksum_of_pictures(scenes::pack(name), 8, true), expected)
          << name << ", " << instruction_set_name(set);
    }
  }
  force_instruction_set(std::nullopt);
}

}  // namespace
}  // namespace triptych
