// OSMesa: OpenGL in memory alone, where not even EGL is to be had.
#pragma once

#include <memory>

#include "render/context.hpp"

namespace triptych {

std::unique_ptr<Context> make_osmesa_context();

}  // namespace triptych
