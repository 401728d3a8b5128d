#include "nodes/memory_keeper.hpp"

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/notice.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <utility>

namespace triptych {

namespace {

/// Less is too little for the parts of any picture.
constexpr uint64_t least_geometry = 1 << 20;
constexpr double largest_pixel_error = 4096, step_up = 1.25, step_down = 0.95, leap_down = 0.8,
                 plunge_down = 0.5;
/// After so many refusals of one frame its pixel error is doubled each time.
constexpr uint32_t patience = 6;
/// The pixel error is lowered while a frame uses less than this share of its room; faster below the others.
constexpr double roomy = 0.7, empty = 0.4, bare = 0.1;

uint64_t mib(uint64_t bytes) { return (bytes >> 20) + 1; }

/// What is left for the rest: allocations of a frame, what the allocator holds back.
uint64_t reserve_of(uint64_t memory) { return memory / 16; }

}  // namespace

MemoryKeeper::MemoryKeeper(Device& device, const MemoryCaps& caps, uint64_t read_ahead,
                           uint64_t picture_bytes, NoPixelError otherwise)
    : device_(device), caps_(caps), otherwise_(otherwise) {
  if (!caps.capped()) return;
  uint64_t room = caps.device_memory;
  if (caps.memory != no_cap) {
    keep_freed_memory_below(caps.memory / 64);
    release_freed_memory();
    const uint64_t others = resident_bytes() + picture_bytes + read_ahead + reserve_of(caps.memory);
    const uint64_t least = std::max(peak_resident_bytes(), others + least_geometry);
    if (least > caps.memory) {
      fail("--memory",
           "{} MiB, but the program, what the pack says of its parts, and the pictures take "
           "{} MiB without any geometry; at least {} MiB are needed",
           caps.memory >> 20, mib(others), mib(least + least / 8));
    }
    room = std::min(room, caps.memory - others);
  }
  if (room < least_geometry)
    fail("--device-memory", "{} KiB are too little for any picture; at least 1 MiB are needed", room >> 10);
  give_to_geometry(room);
}

void MemoryKeeper::give_to_geometry(uint64_t bytes) {
  geometry_ = bytes;
  device_.set_geometry_cap(bytes);
}

double MemoryKeeper::raise(double asked) const { return std::max(asked, held_); }

void MemoryKeeper::crowded(double pixel_error) {
  constexpr double smallest = 0.25;
  held_ = std::min(largest_pixel_error, std::max(smallest, pixel_error * step_up));
}

void MemoryKeeper::refused(double pixel_error, const NoRoom& why) {
  if (pixel_error >= largest_pixel_error && otherwise_ == NoPixelError::leaves_out) {
    leaves_out_ = true;
    return;
  }
  if (pixel_error >= largest_pixel_error) {
    const bool device = caps_.memory == no_cap;
    const uint64_t cap = device ? caps_.device_memory : caps_.memory;
    fail(device ? "--device-memory" : "--memory",
         "{} MiB leave {:.1f} MiB for geometry, and what this frame shows takes more at any pixel error; at "
         "least {} MiB are needed",
         cap >> 20, static_cast<double>(geometry_) / 0x1p20, mib(cap + why.needed() - geometry_));
  }
  crowded(++refusals_ > patience ? 2 / step_up * pixel_error : pixel_error);
}

bool MemoryKeeper::drawn(bool all) {
  const bool refused = std::exchange(refusals_, 0) > 0;
  leaves_out_ = leaves_out_ && !all;
  if (geometry_ == no_cap) return false;
  const GeometryUse use = device_.geometry_use();
  const double used = static_cast<double>(use.view_bytes) / static_cast<double>(use.cap);
  const double before = held_;
  if (all && used < roomy) held_ *= used < bare ? plunge_down : used < empty ? leap_down : step_down;
  if (held_ < 0.01) held_ = 0;
  keep_below_cap();
  return held_ < before && !refused;
}

void MemoryKeeper::keep_below_cap() {
  if (caps_.memory == no_cap) return;
  const uint64_t limit = caps_.memory - reserve_of(caps_.memory) / 2;
  uint64_t resident = resident_bytes();
  if (resident <= limit) return;
  release_freed_memory();
  resident = resident_bytes();
  if (resident <= limit) return;
  if (geometry_ > least_geometry) {
    give_to_geometry(std::max(least_geometry, geometry_ - std::min(geometry_, resident - limit)));
  } else if (resident > caps_.memory && !std::exchange(said_, true)) {
    notice("--memory: the process takes {} MiB, more than its {}, with hardly any geometry: more is needed",
           mib(resident), caps_.memory >> 20);
  }
}

}  // namespace triptych
