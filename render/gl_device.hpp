// The device `gl`: OpenGL draws and tests.
#pragma once

#include "lod/representation.hpp"
#include "residency/residency.hpp"
#include "visibility/device.hpp"

#include <memory>

namespace triptych {

/// How rectangles are tested. Both give the same answers; which is faster depends on the machine.
enum class TestKind {
  queries,  ///< one occlusion query a rectangle (any samples passed)
  storage,  ///< all rectangles in one instanced draw; fragments that pass mark their slot
};

/// A device in the context that is current in this thread, which must be current whenever the device or one
/// of its targets is used. Geometry is requested from the residency when it is first drawn, and stays in
/// device memory. Error where OpenGL reports one.
std::unique_ptr<Device> make_gl_device(const Skeleton& skeleton, Representation& representation,
                                       Residency& residency, TestKind test);

/// RGBA of the back buffer of the window whose context is current, width × height, bottom row first.
std::vector<uint8_t> read_window(int width, int height);

}  // namespace triptych
