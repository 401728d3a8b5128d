// OSMesa: OpenGL in main memory, for machines without EGL.
#pragma once

#include "render/context.hpp"

#include <memory>

namespace triptych {

std::unique_ptr<Context> make_osmesa_context();

}  // namespace triptych
