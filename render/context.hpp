// OpenGL 4.5 core without a window: EGL surfaceless or OSMesa, chosen at run time.
#pragma once

#include "visibility/device.hpp"

#include <memory>
#include <string>

namespace triptych {

enum class ContextKind { egl, osmesa };

/// A current OpenGL context of this thread, with its functions loaded. Only one kind per process: the loaded
/// functions are those of the first context. Error where the machine offers none.
class Context {
 public:
  virtual ~Context() = default;
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  const DeviceNames& names() const { return names_; }

 protected:
  /// Loads the functions and sets the state that every pass shares: reversed depth in 0 to 1.
  using Loader = void (*(*)(const char* name))();
  void load(Loader loader, const std::string& place);

 private:
  DeviceNames names_;
};

std::unique_ptr<Context> make_context(ContextKind kind);

/// The names of the current context's OpenGL.
DeviceNames current_opengl();

}  // namespace triptych
