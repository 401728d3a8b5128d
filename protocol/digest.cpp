#include "protocol/digest.hpp"

#include "base/hashing.hpp"

#include <array>
#include <cassert>
#include <cstring>

namespace triptych {

uint64_t frame_digest(uint32_t frame, const FrameState& state, uint64_t pack_hash,
                      const VisibleSet& visible) {
  const View& view = state.view;
  const Camera& camera = view.camera;
  std::array<std::byte, 4 + 15 * 8 + 1 + 2 * 4 + 4 + 1 + 8> fields;
  std::byte* end = fields.data();
  const auto add = [&](const auto& value) {
    std::memcpy(end, &value, sizeof(value));
    end += sizeof(value);
  };
  add(frame);
  for (const auto* vector : {&camera.eye, &camera.target, &camera.up}) {
    for (int axis = 0; axis < 3; ++axis) add((*vector)[axis]);
  }
  for (const double value :
       {camera.left, camera.right, camera.bottom, camera.top, camera.near, state.pixel_error}) {
    add(value);
  }
  add(static_cast<uint8_t>(camera.projection));
  add(view.width);
  add(view.height);
  add(state.samples);
  add(static_cast<uint8_t>(state.edges));
  add(pack_hash);
  assert(end == fields.data() + fields.size());
  return hash_values(std::span<const DrawableId>(visible), hash_bytes(fields));
}

}  // namespace triptych
