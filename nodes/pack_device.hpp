// A pack and the device that draws it.
#pragma once

#include "lod/hierarchy.hpp"
#include "render/gl_device.hpp"
#include "residency/load_on_demand.hpp"
#include "scene/pack.hpp"
#include "visibility/device.hpp"

#include <memory>

namespace triptych {

struct DeviceOptions {
  TestKind test = TestKind::storage;  ///< of `gl`
};

/// What every process that draws builds from a pack, which must outlive it. A context must be current.
class PackDevice {
 public:
  explicit PackDevice(const Pack& pack, const DeviceOptions& options = {})
      : hierarchy_(pack.skeleton()),
        representation_(hierarchy_),
        residency_(pack),
        device_(make_gl_device(pack.skeleton(), representation_, residency_, options.test)) {}

  const Hierarchy& hierarchy() const { return hierarchy_; }
  const Skeleton& skeleton() const { return hierarchy_.skeleton(); }
  Device& device() { return *device_; }

 private:
  Hierarchy hierarchy_;
  LevelsRepresentation representation_;
  LoadOnDemand residency_;
  std::unique_ptr<Device> device_;
};

}  // namespace triptych
