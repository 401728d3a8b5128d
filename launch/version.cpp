#include "launch/version.hpp"

#include "base/error.hpp"
#include "commit.hpp"  // made by cmake/TriptychCommit.cmake
#include "nodes/device_choice.hpp"
#include "raster/instruction_set.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

/// The OpenGL of a context, or why there is none.
std::string opengl_text(ContextKind kind) {
  try {
    const DeviceNames names = choose_device({.kind = DeviceKind::gl, .context = kind}).names;
    return fmt::format("{}, {}{}", names.renderer, names.version,
                       is_graphics_card(names) ? "" : " (no graphics card: it draws with the processor)");
  } catch (const Error& error) {
    return fmt::format("none: {}", error.what());
  }
}

}  // namespace

std::string program_version() { return TRIPTYCH_VERSION; }

std::string version_and_commit() {
  const std::string commit = TRIPTYCH_COMMIT;
  return program_version() + (commit.empty() ? "" : ", commit " + commit);
}

std::string version_text() {
  const ChosenDevice chosen = choose_device({.kind = DeviceKind::automatic});
  return fmt::format(
      "triptych {}\nbuilt: {} by {}, flags \"{}\"\ndevice: {}, by default\ncpu: {} instructions\nOpenGL of "
      "EGL: {}",
      version_and_commit(), TRIPTYCH_BUILD_TYPE, TRIPTYCH_COMPILER, TRIPTYCH_FLAGS,
      device_name(chosen.options.kind), instruction_set_name(instruction_set()),
      opengl_text(ContextKind::egl));
}

}  // namespace triptych
