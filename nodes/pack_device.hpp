// A pack and the device that draws it.
#pragma once

#include "lod/hierarchy.hpp"
#include "nodes/device_choice.hpp"
#include "residency/load_on_demand.hpp"
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

 private:
  Hierarchy hierarchy_;
  LevelsRepresentation representation_;
  LoadOnDemand residency_;
  std::unique_ptr<Device> device_;
};

}  // namespace triptych
