#include "base/error.hpp"
#include "model/import/import_gltf.hpp"

#include <cstring>

namespace triptych {

namespace {

/// The most elements of a sparse accessor without a base: its zeros take memory although no byte of the file
/// holds them.
constexpr size_t max_implied_count = size_t{1} << 24;

size_t component_bytes(int type, const std::string& place) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_INT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return 8;
    default:
      fail(place, "component type {} is not known", type);
  }
}

int component_count(int type, const std::string& place) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    default:
      fail(place, "a matrix where a scalar or a vector is expected");
  }
}

/// The bytes of `count` elements at an offset of a buffer view; Error if they leave the view, or the view its
/// buffer.
GltfBuffer checked_range(const GltfFile& gltf, int view_index, size_t offset, size_t count, size_t element,
                         size_t stride, const std::string& place) {
  const auto& views = gltf.model.bufferViews;
  if (view_index < 0 || static_cast<size_t>(view_index) >= views.size()) {
    fail(place, "names buffer view {} of {}", view_index, views.size());
  }
  const auto& view = views[static_cast<size_t>(view_index)];
  if (view.buffer < 0 || static_cast<size_t>(view.buffer) >= gltf.buffers.size()) {
    fail(place, "buffer view {} names buffer {} of {}", view_index, view.buffer, gltf.buffers.size());
  }
  const GltfBuffer& buffer = gltf.buffers[static_cast<size_t>(view.buffer)];
  if (view.byteOffset > buffer.size || view.byteLength > buffer.size - view.byteOffset) {
    fail(place, "buffer view {} goes beyond its buffer of {} bytes", view_index, buffer.size);
  }
  const bool fits = count == 0 || (offset <= view.byteLength && element <= view.byteLength - offset &&
                                   count - 1 <= (view.byteLength - offset - element) / stride);
  if (!fits)
    fail(place, "{} elements go beyond buffer view {} of {} bytes", count, view_index, view.byteLength);
  if (count == 0) return {buffer.source, buffer.offset, 0};
  return {buffer.source, buffer.offset + view.byteOffset + offset, (count - 1) * stride + element};
}

std::vector<std::byte> read_range(const GltfBuffer& range) {
  std::vector<std::byte> bytes(range.size);
  SourceReader(range.source).read(range.offset, bytes);
  return bytes;
}

size_t stride_of(const GltfFile& gltf, int view_index, size_t element, const std::string& place) {
  const auto& views = gltf.model.bufferViews;
  if (view_index < 0 || static_cast<size_t>(view_index) >= views.size()) return element;
  const size_t stride = views[static_cast<size_t>(view_index)].byteStride;
  if (stride != 0 && stride < element) fail(place, "elements of {} bytes at a stride of {}", element, stride);
  return stride == 0 ? element : stride;
}

bool is_index_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

ScalarType scalar_type_of(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return ScalarType::int8;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return ScalarType::uint8;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return ScalarType::int16;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return ScalarType::uint16;
    case TINYGLTF_COMPONENT_TYPE_INT:
      return ScalarType::int32;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return ScalarType::uint32;
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return ScalarType::float32;
    default:
      return ScalarType::float64;
  }
}

}  // namespace

GltfAccessor::GltfAccessor(const GltfFile& gltf, int accessor_index, const std::string& file_place) {
  const auto& accessors = gltf.model.accessors;
  if (accessor_index < 0 || static_cast<size_t>(accessor_index) >= accessors.size()) {
    fail(file_place, "names accessor {} of {}", accessor_index, accessors.size());
  }
  const std::string place = fmt::format("{} accessor {}", file_place, accessor_index);
  const auto& accessor = accessors[static_cast<size_t>(accessor_index)];
  component_type_ = accessor.componentType;
  components_ = component_count(accessor.type, place);
  normalized_ = accessor.normalized && component_type_ < TINYGLTF_COMPONENT_TYPE_FLOAT;
  sparse_ = accessor.sparse.isSparse;
  count_ = accessor.count;
  element_bytes_ = component_bytes(component_type_, place) * static_cast<size_t>(components_);
  stride_ = stride_of(gltf, accessor.bufferView, element_bytes_, place);
  if (accessor.bufferView >= 0 || !sparse_) {
    data_ =
        checked_range(gltf, accessor.bufferView, accessor.byteOffset, count_, element_bytes_, stride_, place);
  } else if (count_ > max_implied_count) {
    fail(place, "{} elements without a buffer view", count_);
  }
  if (!sparse_) return;
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
    fail(place, "a negative count or offset");
  if (!is_index_type(sparse.indices.componentType))
    fail(place, "sparse indices of component type {}", sparse.indices.componentType);
  const auto sparse_count = static_cast<size_t>(sparse.count);
  const size_t index_bytes = component_bytes(sparse.indices.componentType, place);
  const auto indices = read_range(checked_range(gltf, sparse.indices.bufferView,
                                                static_cast<size_t>(sparse.indices.byteOffset), sparse_count,
                                                index_bytes, index_bytes, place));
  sparse_values_ =
      checked_range(gltf, sparse.values.bufferView, static_cast<size_t>(sparse.values.byteOffset),
                    sparse_count, element_bytes_, element_bytes_, place);
  sparse_indices_.resize(sparse_count);
  for (size_t i = 0; i < sparse_count; ++i) {
    sparse_indices_[i] = static_cast<uint32_t>(
        load_scalar(indices.data() + i * index_bytes, scalar_type_of(sparse.indices.componentType), false));
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
  const auto values = read_range(sparse_values_);
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
