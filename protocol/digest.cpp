#include "protocol/digest.hpp"

#include "base/bytes.hpp"
#include "base/hashing.hpp"

namespace triptych {

uint64_t frame_digest(uint32_t frame, const FrameState& state, uint64_t pack_hash,
                      const VisibleSet& visible) {
  const View& view = state.view;
  const Camera& camera = view.camera;
  ByteWriter fields;
  fields.write(frame);
  for (const auto* vector : {&camera.eye, &camera.target, &camera.up}) {
    for (int axis = 0; axis < 3; ++axis) fields.write((*vector)[axis]);
  }
  for (const double value :
       {camera.left, camera.right, camera.bottom, camera.top, camera.near, state.pixel_error}) {
    fields.write(value);
  }
  fields.write(static_cast<uint8_t>(camera.projection));
  fields.write(view.width);
  fields.write(view.height);
  fields.write(pack_hash);
  return hash_values(std::span<const DrawableId>(visible), hash_bytes(fields.bytes()));
}

}  // namespace triptych
