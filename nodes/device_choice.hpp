// What a process draws with: OpenGL or the rasteriser, chosen once.
#pragma once

#include "nodes/memory_caps.hpp"
#include "render/context.hpp"
#include "render/gl_device.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace triptych {

enum class DeviceKind : uint8_t {
  automatic,  ///< gl where OpenGL's renderer is a graphics card, else cpu
  gl,
  cpu
};
/// As --device has it: auto, gl, cpu.
const std::string& device_name(DeviceKind kind);

struct DeviceOptions {
  DeviceKind kind = DeviceKind::cpu;
  ContextKind context = ContextKind::egl;  ///< of `gl`
  TestKind test = TestKind::storage;       ///< of `gl`
  MemoryCaps memory = {};
  bool operator==(const DeviceOptions&) const = default;
};

struct ChosenDevice {
  DeviceOptions options;  ///< gl or cpu
  std::unique_ptr<Context>
      context;  ///< of `gl`: current in this thread. Null where a window has it, and of `cpu`
  DeviceNames names;
};

/// Error where `gl` is asked for and the machine offers none.
ChosenDevice choose_device(const DeviceOptions& wanted);
/// The same in a window, whose context is current and says this of itself.
ChosenDevice choose_device(const DeviceOptions& wanted, const DeviceNames& window);

/// Which of the two says this of itself.
DeviceKind kind_of(const DeviceNames& names);

/// Whether an OpenGL that says this of itself draws with a graphics card, and not with the processor.
bool is_graphics_card(const DeviceNames& names);

}  // namespace triptych
