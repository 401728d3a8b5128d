// OSMesa: OpenGL in memory alone, where not even EGL is to be had.
#pragma once

#include "render/context.hpp"

#include <memory>

namespace triptych {

std::unique_ptr<Context> make_osmesa_context();

}  // namespace triptych
