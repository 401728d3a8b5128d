// EGL without a surface: any graphics card or software renderer, no display needed.
#pragma once

#include "render/context.hpp"

#include <memory>

namespace triptych {

std::unique_ptr<Context> make_egl_context();

}  // namespace triptych
