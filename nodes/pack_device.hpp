// A pack and the device that draws it.
#pragma once

#include "lod/hierarchy.hpp"
#include "nodes/device_choice.hpp"
#include "residency/read_ahead.hpp"
#include "scene/pack.hpp"
#include "visibility/device.hpp"

#include <memory>

namespace triptych {

/// What every process that draws builds from a pack, which must outlive it.
class PackDevice {
 public:
  /// options: of a chosen device. Of `gl`, its context must be current here and wherever the device is used.
  explicit PackDevice(const Pack& pack, const DeviceOptions& options = {});

  const Hierarchy& hierarchy() const { return hierarchy_; }
  const Skeleton& skeleton() const { return hierarchy_.skeleton(); }
  Device& device() { return *device_; }
  const Representation& representation() const { return representation_; }
  /// Null where nothing is read ahead: without caps, of a file, once read, chunks stay.
  ReadAhead* read_ahead() const { return read_ahead_; }
  /// Bytes that are read ahead at most.
  static uint64_t read_ahead_bytes(const MemoryCaps& caps);

 private:
  Hierarchy hierarchy_;
  LevelsRepresentation representation_;
  std::unique_ptr<Residency> residency_;
  ReadAhead* read_ahead_ = nullptr;  ///< where the residency is one
  std::unique_ptr<Device> device_;
};

}  // namespace triptych
