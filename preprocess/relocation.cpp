#include "preprocess/relocation.hpp"

#include "preprocess/triangle_objects.hpp"
#include "scene/stored_objects.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// Adds modulo 2^32; an empty span stays empty, and no object none.
void shift(std::span<LeafSpan> spans, uint32_t places, std::span<SourceObjectId> objects, uint32_t by) {
  for (LeafSpan& span : spans) {
    if (span.first > span.last) continue;
    span.first += places;
    span.last += places;
  }
  for (SourceObjectId& object : objects) {
    if (object != no_id) object += by;
  }
}

}  // namespace

void Relocation::take_in(std::span<const SourceObjectId> objects) {
  for (const SourceObjectId object : objects) first_object_ = std::min(first_object_, object);
}

void Relocation::to_own(std::span<LeafSpan> spans, std::span<SourceObjectId> objects) const {
  shift(spans, own_first_place - first_place_, objects, 0 - first_object_);
}

void Relocation::to_model(std::span<LeafSpan> spans, std::span<SourceObjectId> objects) const {
  shift(spans, first_place_ - own_first_place, objects, first_object_);
}

std::vector<std::byte> Relocation::to_model(std::span<const std::byte> triangle_objects) const {
  std::vector<SourceObjectId> objects;
  each_run(triangle_objects, "objects of triangles", [&](uint64_t count, SourceObjectId object) {
    objects.insert(objects.end(), count, object == no_id ? no_id : object + first_object_);
  });
  return encode_triangle_objects(objects);
}

}  // namespace triptych
