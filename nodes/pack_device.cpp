#include "nodes/pack_device.hpp"

#include "raster/raster_device.hpp"

#include <cassert>

namespace triptych {

PackDevice::PackDevice(const Pack& pack, const DeviceOptions& options)
    : hierarchy_(pack.skeleton()), representation_(hierarchy_), residency_(pack) {
  assert(options.kind != DeviceKind::automatic);
  device_ = options.kind == DeviceKind::gl
                ? make_gl_device(pack.skeleton(), representation_, residency_, options.test)
                : make_raster_device(pack.skeleton(), representation_, residency_);
}

}  // namespace triptych
