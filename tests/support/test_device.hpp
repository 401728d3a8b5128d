// The device that tests draw with.
#pragma once

#include "nodes/device_choice.hpp"

#include <cstdlib>
#include <string>

namespace triptych::test {

/// As the environment's TRIPTYCH_TEST_DEVICE says: cpu (which it is without it), egl, or osmesa, where boxes
/// are tested by queries.
inline DeviceOptions wanted_device() {
  const char* value = std::getenv("TRIPTYCH_TEST_DEVICE");
  const std::string name = value ? value : "cpu";
  if (name == "egl") return {DeviceKind::gl, ContextKind::egl, TestKind::storage};
  if (name == "osmesa") return {DeviceKind::gl, ContextKind::osmesa, TestKind::queries};
  return {DeviceKind::cpu};
}

/// The same, with its context; made once in a process.
inline const DeviceOptions& device() {
  static const ChosenDevice chosen = choose_device(wanted_device());
  return chosen.options;
}

inline bool on_gl() { return device().kind == DeviceKind::gl; }

}  // namespace triptych::test
