// The pack's section OBJS as bytes; scene/stored_objects.hpp reads them back.
#pragma once

#include "scene/stored_objects.hpp"

#include <cstddef>
#include <vector>

namespace triptych {

/// Texts are sorted, and written by what they share with the one before; arrays are compressed with
/// meshoptimizer's codec for vertices (Arseny Kapoulkine).
std::vector<std::byte> encode_objects(const StoredObjects& stored);

}  // namespace triptych
