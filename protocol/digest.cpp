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
  constexpr size_t section_bytes = 2 + Section::max_planes * 4 * 8 + 6 * 8;
  std::array<std::byte, 4 + 15 * 8 + 1 + 2 * 4 + 4 + 1 + 4 + section_bytes + 4 + 8 + 8 + 1 + 3 * 8 + 8>
      fields;
  std::byte* end = fields.data();
  const auto add = [&](const auto& value) {
    std::memcpy(end, &value, sizeof(value));
    end += sizeof(value);
  };
  const auto add_vector = [&](const glm::dvec3& vector) {
    for (int axis = 0; axis < 3; ++axis) add(vector[axis]);
  };
  add(frame);
  for (const auto* vector : {&camera.eye, &camera.target, &camera.up}) add_vector(*vector);
  for (const double value :
       {camera.left, camera.right, camera.bottom, camera.top, camera.near, state.pixel_error}) {
    add(value);
  }
  add(static_cast<uint8_t>(camera.projection));
  add(view.width);
  add(view.height);
  add(state.samples);
  add(static_cast<uint8_t>(state.edges));
  add(state.effects.bits());
  const Section& section = state.section;
  add(static_cast<uint8_t>(section.planes().size()));
  for (const SectionPlane& plane : section.planes()) {
    add_vector(plane.normal);
    add(plane.offset);
  }
  add(static_cast<uint8_t>(section.box().has_value()));
  if (section.box()) {
    add_vector(section.box()->lo);
    add_vector(section.box()->hi);
  }
  add(state.hiding.name.count);
  add(state.hiding.name.hash);
  add(state.time + 0.0);  // −0 is 0
  add(static_cast<uint8_t>(state.sky.shown));
  add_vector(state.sky.to_sun);
  add(pack_hash);
  const auto used = static_cast<size_t>(end - fields.data());
  assert(used <= fields.size());
  return hash_values(std::span<const DrawableId>(visible), hash_bytes(std::span(fields).first(used)));
}

}  // namespace triptych
