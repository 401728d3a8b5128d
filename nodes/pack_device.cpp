#include "nodes/pack_device.hpp"

#include "raster/raster_device.hpp"
#include "residency/load_on_demand.hpp"

#include <algorithm>
#include <cassert>

namespace triptych {

PackDevice::PackDevice(const Pack& pack, const DeviceOptions& options)
    : hierarchy_(pack.skeleton()), representation_(hierarchy_) {
  assert(options.kind != DeviceKind::automatic);
  const ByteSource::Habits habits = pack.source().habits();
  if (options.memory.streams() || habits.far) {
    auto read_ahead = std::make_unique<ReadAhead>(pack, habits.threads, read_ahead_bytes(options.memory));
    read_ahead_ = read_ahead.get();
    residency_ = std::move(read_ahead);
  } else {
    residency_ = std::make_unique<LoadOnDemand>(pack);
  }
  device_ = options.kind == DeviceKind::gl
                ? make_gl_device(pack.skeleton(), representation_, *residency_, options.test)
                : make_raster_device(pack.skeleton(), representation_, *residency_);
}

uint64_t PackDevice::read_ahead_bytes(const MemoryCaps& caps) {
  constexpr uint64_t enough = 256 << 20;
  // What frames wait for is read by them; what they do not wait for comes by the threads alone.
  const uint64_t share = caps.on_miss == OnMiss::exact ? 16 : 6;
  return std::min(std::min(caps.memory, caps.device_memory) / share, enough);
}

}  // namespace triptych
