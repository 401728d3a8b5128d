#include "nodes/streaming.hpp"

#include <algorithm>

namespace triptych {

uint64_t picture_bytes_of(const FrameState& state) {
  // Depth, ids, and colours, for each sample, and a copy of the picture.
  constexpr uint64_t a_sample = 16, a_pixel = 8;
  const uint64_t pixels = static_cast<uint64_t>(state.view.width) * static_cast<uint64_t>(state.view.height);
  return (a_sample * state.samples + a_pixel) * pixels;
}

Streaming::Streaming(PackDevice& device, const MemoryCaps& caps, const FrameState& first,
                     MemoryKeeper::NoPixelError otherwise)
    : pack_device_(device),
      device_(device.device()),
      residency_(*device.read_ahead()),
      keeper_(device_, caps, PackDevice::read_ahead_bytes(caps), picture_bytes_of(first), otherwise),
      prefetch_(device.hierarchy(), device_, residency_, PackDevice::read_ahead_bytes(caps) / 4) {
  if (caps.on_miss == OnMiss::coarser) substitutes_.emplace(device.hierarchy(), device_, residency_);
}

void Streaming::begin_frame() {
  residency_.next_frame();
  no_room_ = device_.geometry_use().no_room;
}

void Streaming::begin_drawing() {
  left_out_ = device_.geometry_use().left_out;
  const bool exact = !substitutes_;
  device_.set_missing({.wait = exact, .refuse = exact && !leaves_out(), .fail = exact});
}

void Streaming::complete(PictureStage& picture, const FrameView& view, const VisibleSet& visible,
                         FrameRecord& record) {
  record.owed_drawables = record.left_out_drawables = 0;
  shown_ = visible;
  if (substitutes_ && device_.geometry_use().left_out > left_out_) {
    record.owed_drawables = substitutes_->replace(view, shown_);
    std::vector<DrawableId> ordered = shown_;
    sorter_.sort(view, ordered);
    device_.set_missing({.wait = true, .refuse = !leaves_out(), .fail = false});
    picture.begin(view, record.number);
    picture.draw(ordered);
  }
  if (leaves_out()) record.left_out_drawables = count_without_room(shown_);
}

uint64_t Streaming::count_without_room(const VisibleSet& visible) const {
  const auto has_room = [&](const Placement& placement) {
    return device_.has_chunk(placement.chunk) || device_.is_damaged(placement.chunk);
  };
  return static_cast<uint64_t>(std::ranges::count_if(visible, [&](DrawableId id) {
    return !std::ranges::all_of(pack_device_.hierarchy().placements_of(id), has_room);
  }));
}

void Streaming::drawn(const FrameView& view, const VisibleSet& visible, double asked, FrameRecord& record,
                      const View* next) {
  device_.set_missing({.wait = true, .refuse = false, .fail = !substitutes_});
  record.raised_for_memory = record.pixel_error > asked;
  const bool has_room = keeper_.drawn(record.left_out_drawables == 0);
  if (device_.geometry_use().no_room > no_room_) keeper_.crowded(record.pixel_error);
  prefetch_.drawn(view, visible, next);
  const bool is_read =
      record.owed_drawables > 0 && record.left_out_drawables == 0 && residency_.use().open > 0;
  record.gets_finer = is_read || (has_room && record.raised_for_memory);
}

OccluderStreaming::OccluderStreaming(PackDevice& device, const MemoryCaps& caps, const FrameState& first)
    : device_(device),
      keeper_(device.device(), caps, PackDevice::read_ahead_bytes(caps), picture_bytes_of(first)) {}

void OccluderStreaming::begin_frame(bool wait) {
  device_.read_ahead()->next_frame();
  device_.device().set_missing({.wait = wait, .refuse = false, .fail = false});
}

}  // namespace triptych
