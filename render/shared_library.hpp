// Libraries that are loaded when they are needed, so that the program runs where they are not there.
#pragma once

#include "base/error.hpp"

#include <dlfcn.h>
#include <string>

namespace triptych {

/// Stays loaded until the process ends: drivers keep pointers into it.
class SharedLibrary {
 public:
  /// Error (place) where there is no such file.
  SharedLibrary(std::string place, const char* file)
      : place_(std::move(place)), handle_(::dlopen(file, RTLD_NOW | RTLD_LOCAL)) {
    if (!handle_) fail(place_, "is not there: {}", ::dlerror());
  }

  /// Error (place) where the library lacks it.
  template <typename Function>
  void find(const char* name, Function& function) const {
    function = reinterpret_cast<Function>(::dlsym(handle_, name));
    if (!function) fail(place_, "is too old: it has no {}", name);
  }

 private:
  std::string place_;
  void* handle_;
};

}  // namespace triptych
