#include "base/error.hpp"
#include "model/import/import_gltf.hpp"

#include <cstring>
#include <map>

namespace triptych {

namespace {

/// The most elements of a sparse accessor without a base: its zeros take memory although no byte of the file
/// holds them.
constexpr size_t max_implied_count = size_t{1} << 24;

size_t component_bytes(int type, const std::string& place) {
  switch (type) {
    case gltf_byte:
    case gltf_unsigned_byte:
      return 1;
    case gltf_short:
    case gltf_unsigned_short:
      return 2;
    case gltf_int:
    case gltf_unsigned_int:
    case gltf_float:
      return 4;
    case gltf_double:
      return 8;
    default:
      fail(place, "component type {} is not known", type);
  }
}

int component_count(const std::string& type, const std::string& place) {
  static const std::map<std::string, int> counts = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  const auto found = counts.find(type);
  if (found == counts.end())
    fail(place, "a type of elements that is not expected: \"{}\"", type.substr(0, 20));
  return found->second;
}

/// The bytes of `count` elements at an offset of a buffer view; Error if they leave the view, or the view its
/// buffer.
GltfBuffer checked_range(const GltfFile& gltf, int64_t view_index, size_t offset, size_t count,
                         size_t element, size_t stride, const std::string& place) {
  const GltfBuffer view = gltf_view_bytes(gltf, view_index, place);
  const bool fits = count == 0 || (offset <= view.size && element <= view.size - offset &&
                                   count - 1 <= (view.size - offset - element) / stride);
  if (!fits) fail(place, "{} elements go beyond buffer view {} of {} bytes", count, view_index, view.size);
  if (count == 0) return {view.source, view.offset, 0};
  return {view.source, view.offset + offset, (count - 1) * stride + element};
}

size_t stride_of(const GltfFile& gltf, int64_t view_index, size_t element, const std::string& place) {
  const auto& views = gltf.model.views;
  if (view_index < 0 || static_cast<size_t>(view_index) >= views.size()) return element;
  const auto& view = views[static_cast<size_t>(view_index)];
  const size_t stride = view.meshopt ? view.meshopt->stride : view.stride;
  if (stride != 0 && stride < element) fail(place, "elements of {} bytes at a stride of {}", element, stride);
  return stride == 0 ? element : stride;
}

bool is_index_type(int type) {
  return type == gltf_unsigned_byte || type == gltf_unsigned_short || type == gltf_unsigned_int;
}

ScalarType scalar_type_of(int type) {
  switch (type) {
    case gltf_byte:
      return ScalarType::int8;
    case gltf_unsigned_byte:
      return ScalarType::uint8;
    case gltf_short:
      return ScalarType::int16;
    case gltf_unsigned_short:
      return ScalarType::uint16;
    case gltf_int:
      return ScalarType::int32;
    case gltf_unsigned_int:
      return ScalarType::uint32;
    case gltf_float:
      return ScalarType::float32;
    default:
      return ScalarType::float64;
  }
}

}  // namespace

GltfAccessor::GltfAccessor(const GltfFile& gltf, int64_t accessor_index, const std::string& file_place) {
  const auto& accessors = gltf.model.accessors;
  if (accessor_index < 0 || static_cast<size_t>(accessor_index) >= accessors.size()) {
    fail(file_place, "names accessor {} of {}", accessor_index, accessors.size());
  }
  const std::string place = fmt::format("{} accessor {}", file_place, accessor_index);
  const auto& accessor = accessors[static_cast<size_t>(accessor_index)];
  component_type_ = accessor.component_type;
  components_ = component_count(accessor.type, place);
  normalized_ = accessor.normalized && component_type_ < gltf_float;
  sparse_ = accessor.sparse.has_value();
  count_ = accessor.count;
  element_bytes_ = component_bytes(component_type_, place) * static_cast<size_t>(components_);
  stride_ = stride_of(gltf, accessor.view, element_bytes_, place);
  if (accessor.view >= 0 || !sparse_) {
    data_ = checked_range(gltf, accessor.view, accessor.offset, count_, element_bytes_, stride_, place);
  } else if (count_ > max_implied_count) {
    fail(place, "{} elements without a buffer view", count_);
  }
  if (!sparse_) return;
  const GltfSparse& sparse = *accessor.sparse;
  if (!is_index_type(sparse.indices_type))
    fail(place, "sparse indices of component type {}", sparse.indices_type);
  if (sparse.count > count_) fail(place, "{} sparse elements of {}", sparse.count, count_);
  const size_t index_bytes = component_bytes(sparse.indices_type, place);
  const auto indices = read_gltf_bytes(checked_range(gltf, sparse.indices_view, sparse.indices_offset,
                                                     sparse.count, index_bytes, index_bytes, place));
  sparse_values_ = checked_range(gltf, sparse.values_view, sparse.values_offset, sparse.count, element_bytes_,
                                 element_bytes_, place);
  sparse_indices_.resize(sparse.count);
  for (size_t i = 0; i < sparse_indices_.size(); ++i) {
    sparse_indices_[i] = static_cast<uint32_t>(
        load_scalar(indices.data() + i * index_bytes, scalar_type_of(sparse.indices_type), false));
    const bool rising = i == 0 || sparse_indices_[i] > sparse_indices_[i - 1];
    if (!rising || sparse_indices_[i] >= count_)
      fail(place, "sparse indices must rise and stay below {}", count_);
  }
}

bool GltfAccessor::holds_indices() const {
  return components_ == 1 && is_index_type(component_type_) && !normalized_;
}

PositionTable GltfAccessor::positions() const {
  const ScalarType type = scalar_type_of(component_type_);
  const size_t bytes = scalar_bytes(type);
  return {.source = data_.source,
          .offset = data_.offset,
          .count = count_,
          .stride = stride_,
          .fields = {{{0, type}, {bytes, type}, {2 * bytes, type}}},
          .normalized = normalized_};
}

ColorTable GltfAccessor::colors() const {
  ColorTable table{.values = positions(), .linear = true};
  table.values.normalized = component_type_ < gltf_float;
  return table;
}

PositionTable GltfAccessor::coordinates() const {
  PositionTable table = positions();
  table.fields[2] = table.fields[1];  // two components are all that there are
  table.normalized = component_type_ < gltf_float;
  return table;
}

IndexTable GltfAccessor::indices() const {
  return {data_.source, data_.offset, count_, stride_, scalar_type_of(component_type_)};
}

void GltfAccessor::load() {
  elements_.assign(count_ * element_bytes_, std::byte{0});
  if (data_.source && count_ > 0) {
    SourceWindow window(data_.source, data_.offset, data_.offset + data_.size);
    for (size_t i = 0; i < count_; ++i) {
      std::memcpy(elements_.data() + i * element_bytes_, window.take(element_bytes_), element_bytes_);
      if (i + 1 < count_) window.skip(stride_ - element_bytes_);
    }
  }
  if (sparse_indices_.empty()) return;
  const auto values = read_gltf_bytes(sparse_values_);
  for (size_t i = 0; i < sparse_indices_.size(); ++i) {
    std::memcpy(elements_.data() + sparse_indices_[i] * element_bytes_, values.data() + i * element_bytes_,
                element_bytes_);
  }
}

double GltfAccessor::component(size_t i, int c) const {
  const ScalarType type = scalar_type_of(component_type_);
  const std::byte* bytes =
      elements_.data() + i * element_bytes_ + static_cast<size_t>(c) * scalar_bytes(type);
  return load_scalar(bytes, type, false, normalized_);
}

}  // namespace triptych
