// The device `cpu`: a rasteriser of our own. Its pictures are a function of pack and frame state, to the bit,
// on every x86-64 processor and for any number of threads.
#pragma once

#include "lod/representation.hpp"
#include "residency/residency.hpp"
#include "visibility/device.hpp"

#include <cstdint>
#include <limits>
#include <memory>

namespace triptych {

/// What the device says of itself, the same everywhere.
const DeviceNames& raster_device_names();

struct RasterOptions {
  /// Triangles that are numbered in one frame before numbers are used again: tests set fewer. Never fewer
  /// than a picture's pixels.
  uint64_t max_slots = std::numeric_limits<uint32_t>::max();
  /// Fragments of transparent triangles in one list, at most, unless they are of one pixel: more are made in
  /// parts.
  size_t max_fragments = size_t{1} << 20;
};

/// Draws with as many threads as parallel_for (base/threads.hpp). Geometry is asked of the residency when it
/// is drawn, and stays. Targets of up to 16,384 pixels a side: Error (place: frame target) beyond.
std::unique_ptr<Device> make_raster_device(const Skeleton& skeleton, Representation& representation,
                                           Residency& residency, const RasterOptions& options = {});

}  // namespace triptych
