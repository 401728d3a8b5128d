// The device that tests draw with.
#pragma once

#include "nodes/device_choice.hpp"

#include <cstdlib>
#include <string>

namespace triptych::test {

/// As the environment's TRIPTYCH_TEST_DEVICE says: cpu (which it is without it), egl or osmesa, whose boxes
/// are tested by the other of the two ways. Made once in a process.
inline const ChosenDevice& test_device() {
  static const ChosenDevice device = [] {
    const char* value = std::getenv("TRIPTYCH_TEST_DEVICE");
    const std::string name = value ? value : "cpu";
    if (name == "egl") return choose_device({DeviceKind::gl, ContextKind::egl, TestKind::storage});
    if (name == "osmesa") return choose_device({DeviceKind::gl, ContextKind::osmesa, TestKind::queries});
    return choose_device({DeviceKind::cpu});
  }();
  return device;
}

}  // namespace triptych::test
