#include "preprocess/relocation.hpp"

#include "base/error.hpp"
#include "preprocess/triangle_objects.hpp"
#include "scene/stored_objects.hpp"

#include <algorithm>

namespace triptych {

namespace {

void sort_once(std::vector<uint32_t>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

uint32_t index_of(const std::vector<uint32_t>& values, uint32_t value) {
  return static_cast<uint32_t>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
}

/// Of what an earlier build kept under the same key.
uint32_t at(const std::vector<uint32_t>& values, size_t index) {
  if (index >= values.size()) fail("a build's cache", "names a number that its subtree does not have");
  return values[index];
}

/// An empty span stays empty.
template <typename Change>
void change(std::span<LeafSpan> spans, const Change& change_place) {
  for (LeafSpan& span : spans) {
    if (span.first > span.last) continue;
    span.first = change_place(span.first);
    span.last = change_place(span.last);
  }
}

}  // namespace

void Relocation::take_in(std::span<const LeafSpan> spans, std::span<const SourceObjectId> objects) {
  for (const LeafSpan& span : spans) {
    if (span.first > span.last) continue;
    for (const uint32_t place : {span.first, span.last}) {
      if (place < first_place_) before_.push_back(place);
      if (place >= end_place_) behind_.push_back(place);
    }
  }
  for (const SourceObjectId object : objects) {
    // Most follow one like them.
    if (object != no_id && (objects_.empty() || objects_.back() != object)) objects_.push_back(object);
  }
}

void Relocation::finish() {
  for (std::vector<uint32_t>* values : {&before_, &behind_, &objects_}) sort_once(*values);
}

uint32_t Relocation::own_place(uint32_t place) const {
  if (place < first_place_)
    return own_first_place - static_cast<uint32_t>(before_.size()) + index_of(before_, place);
  const uint32_t behind = own_first_place + (end_place_ - first_place_);
  return place < end_place_ ? own_first_place + (place - first_place_) : behind + index_of(behind_, place);
}

uint32_t Relocation::model_place(uint32_t place) const {
  const uint32_t behind = own_first_place + (end_place_ - first_place_);
  if (place < own_first_place) return at(before_, before_.size() - (own_first_place - place));
  return place < behind ? first_place_ + (place - own_first_place) : at(behind_, place - behind);
}

SourceObjectId Relocation::model_object(SourceObjectId object) const {
  return object == no_id ? no_id : at(objects_, object);
}

void Relocation::to_own(std::span<LeafSpan> spans, std::span<SourceObjectId> objects) const {
  change(spans, [&](uint32_t place) { return own_place(place); });
  for (SourceObjectId& object : objects) {
    if (object != no_id) object = index_of(objects_, object);
  }
}

void Relocation::to_model(std::span<LeafSpan> spans, std::span<SourceObjectId> objects) const {
  change(spans, [&](uint32_t place) { return model_place(place); });
  for (SourceObjectId& object : objects) object = model_object(object);
}

std::vector<std::byte> Relocation::to_model(std::span<const std::byte> triangle_objects) const {
  std::vector<SourceObjectId> objects;
  each_run(triangle_objects, "objects of triangles", [&](uint64_t count, SourceObjectId object) {
    objects.insert(objects.end(), count, model_object(object));
  });
  return encode_triangle_objects(objects);
}

}  // namespace triptych
