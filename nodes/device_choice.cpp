#include "nodes/device_choice.hpp"

#include "base/error.hpp"
#include "base/notice.hpp"
#include "raster/raster_device.hpp"

#include <algorithm>
#include <array>

namespace triptych {

const std::string& device_name(DeviceKind kind) {
  static const std::array<std::string, 3> names = {"auto", "gl", "cpu"};
  return names[static_cast<size_t>(kind)];
}

bool is_graphics_card(const DeviceNames& names) {
  static constexpr std::array software = {"llvmpipe",    "softpipe", "swrast",   "SWR",
                                          "SwiftShader", "Software", "software", "GDI Generic"};
  return std::none_of(software.begin(), software.end(),
                      [&](const char* name) { return names.renderer.find(name) != std::string::npos; });
}

DeviceKind kind_of(const DeviceNames& names) {
  return names.vendor == raster_device_names().vendor ? DeviceKind::cpu : DeviceKind::gl;
}

ChosenDevice choose_device(const DeviceOptions& wanted) {
  ChosenDevice chosen{.options = wanted, .context = nullptr, .names = raster_device_names()};
  chosen.options.kind = DeviceKind::cpu;
  if (wanted.kind == DeviceKind::cpu) return chosen;
  std::unique_ptr<Context> context;
  try {
    context = make_context(wanted.context);
  } catch (const Error& error) {
    const char* const osmesa =
        wanted.context == ContextKind::egl ? ", --context osmesa with Mesa's own library" : "";
    if (wanted.kind == DeviceKind::gl)
      throw Error("OpenGL", fmt::format("{}; --device cpu draws without it{}", error.what(), osmesa));
    notice("no OpenGL ({}): drawing without it, as --device cpu does", error.what());
    return chosen;  // without OpenGL there is no card
  }
  if (wanted.kind == DeviceKind::automatic && !is_graphics_card(context->names())) return chosen;
  chosen.options.kind = DeviceKind::gl;
  chosen.names = context->names();
  chosen.context = std::move(context);
  return chosen;
}

ChosenDevice choose_device(const DeviceOptions& wanted, const DeviceNames& window) {
  const bool gl =
      wanted.kind == DeviceKind::gl || (wanted.kind == DeviceKind::automatic && is_graphics_card(window));
  ChosenDevice chosen{.options = wanted, .context = nullptr, .names = gl ? window : raster_device_names()};
  chosen.options.kind = gl ? DeviceKind::gl : DeviceKind::cpu;
  return chosen;
}

}  // namespace triptych
