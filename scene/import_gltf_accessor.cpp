#include "base/error.hpp"
#include "scene/import_gltf.hpp"

#include <algorithm>
#include <cstring>

namespace triptych {

namespace {

/// What a sparse accessor without a base may hold: its zeros take memory that no byte of the file vouches
/// for.
constexpr size_t largest_implied_count = size_t{1} << 24;

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
      fail(place, "a matrix where a scalar or a vector is wanted");
  }
}

/// The bytes of `count` elements at an offset of a buffer view; Error if they leave the view, or the view its
/// buffer.
const uint8_t* checked_range(const tinygltf::Model& gltf, int view_index, size_t offset, size_t count,
                             size_t element, size_t stride, const std::string& place) {
  if (view_index < 0 || static_cast<size_t>(view_index) >= gltf.bufferViews.size()) {
    fail(place, "names buffer view {} of {}", view_index, gltf.bufferViews.size());
  }
  const auto& view = gltf.bufferViews[static_cast<size_t>(view_index)];
  if (view.buffer < 0 || static_cast<size_t>(view.buffer) >= gltf.buffers.size()) {
    fail(place, "buffer view {} names buffer {} of {}", view_index, view.buffer, gltf.buffers.size());
  }
  const auto& bytes = gltf.buffers[static_cast<size_t>(view.buffer)].data;
  if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset) {
    fail(place, "buffer view {} goes beyond its buffer of {} bytes", view_index, bytes.size());
  }
  const bool fits = count == 0 || (offset <= view.byteLength && element <= view.byteLength - offset &&
                                   count - 1 <= (view.byteLength - offset - element) / stride);
  if (!fits)
    fail(place, "{} elements go beyond buffer view {} of {} bytes", count, view_index, view.byteLength);
  return bytes.data() + view.byteOffset + offset;
}

size_t stride_of(const tinygltf::Model& gltf, int view_index, size_t element, const std::string& place) {
  if (view_index < 0 || static_cast<size_t>(view_index) >= gltf.bufferViews.size()) return element;
  const size_t stride = gltf.bufferViews[static_cast<size_t>(view_index)].byteStride;
  if (stride != 0 && stride < element) fail(place, "elements of {} bytes at a stride of {}", element, stride);
  return stride == 0 ? element : stride;
}

template <typename Value>
Value load(const uint8_t* bytes) {
  Value value;
  std::memcpy(&value, bytes, sizeof(value));
  return value;
}

uint32_t load_index(const uint8_t* bytes, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<uint16_t>(bytes);
    default:
      return load<uint32_t>(bytes);
  }
}

bool is_index_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

}  // namespace

GltfAccessor::GltfAccessor(const tinygltf::Model& gltf, int accessor_index, const std::string& file_place) {
  if (accessor_index < 0 || static_cast<size_t>(accessor_index) >= gltf.accessors.size()) {
    fail(file_place, "names accessor {} of {}", accessor_index, gltf.accessors.size());
  }
  const std::string place = fmt::format("{} accessor {}", file_place, accessor_index);
  const auto& accessor = gltf.accessors[static_cast<size_t>(accessor_index)];
  component_type_ = accessor.componentType;
  components_ = component_count(accessor.type, place);
  normalized_ = accessor.normalized;
  count_ = accessor.count;
  const size_t element = component_bytes(component_type_, place) * static_cast<size_t>(components_);
  stride_ = stride_of(gltf, accessor.bufferView, element, place);
  if (accessor.bufferView >= 0 || !accessor.sparse.isSparse) {
    data_ = checked_range(gltf, accessor.bufferView, accessor.byteOffset, count_, element, stride_, place);
  } else if (count_ > largest_implied_count) {
    fail(place, "{} elements without a buffer view", count_);
  }
  if (!accessor.sparse.isSparse) return;
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
    fail(place, "a negative count or offset");
  if (!is_index_type(sparse.indices.componentType))
    fail(place, "sparse indices of component type {}", sparse.indices.componentType);
  sparse_count_ = static_cast<size_t>(sparse.count);
  const size_t index_bytes = component_bytes(sparse.indices.componentType, place);
  const uint8_t* indices =
      checked_range(gltf, sparse.indices.bufferView, static_cast<size_t>(sparse.indices.byteOffset),
                    sparse_count_, index_bytes, index_bytes, place);
  sparse_values_ =
      checked_range(gltf, sparse.values.bufferView, static_cast<size_t>(sparse.values.byteOffset),
                    sparse_count_, element, element, place);
  sparse_indices_.resize(sparse_count_);
  for (size_t i = 0; i < sparse_count_; ++i) {
    sparse_indices_[i] = load_index(indices + i * index_bytes, sparse.indices.componentType);
    const bool rising = i == 0 || sparse_indices_[i] > sparse_indices_[i - 1];
    if (!rising || sparse_indices_[i] >= count_)
      fail(place, "sparse indices must rise and stay below {}", count_);
  }
}

bool GltfAccessor::holds_indices() const {
  return components_ == 1 && is_index_type(component_type_) && !normalized_;
}

size_t GltfAccessor::element_bytes() const {
  return component_bytes(component_type_, "") * static_cast<size_t>(components_);
}

const uint8_t* GltfAccessor::element(size_t i) const {
  if (!sparse_indices_.empty()) {
    const auto found = std::lower_bound(sparse_indices_.begin(), sparse_indices_.end(), i);
    if (found != sparse_indices_.end() && *found == i) {
      return sparse_values_ + static_cast<size_t>(found - sparse_indices_.begin()) * element_bytes();
    }
  }
  return data_ ? data_ + i * stride_ : nullptr;
}

double GltfAccessor::component(size_t i, int c) const {
  const uint8_t* bytes = element(i);
  if (!bytes) return 0;
  const auto scaled = [&](double value, double most) {
    return normalized_ ? std::max(value / most, -1.0) : value;
  };
  switch (component_type_) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return scaled(load<int8_t>(bytes + c), 127);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return scaled(load<uint8_t>(bytes + c), 255);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return scaled(load<int16_t>(bytes + 2 * c), 32767);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return scaled(load<uint16_t>(bytes + 2 * c), 65535);
    case TINYGLTF_COMPONENT_TYPE_INT:
      return scaled(load<int32_t>(bytes + 4 * c), 2147483647);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return scaled(load<uint32_t>(bytes + 4 * c), 4294967295);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return static_cast<double>(load<float>(bytes + 4 * c));
    default:
      return load<double>(bytes + 8 * c);
  }
}

uint32_t GltfAccessor::index(size_t i) const {
  const uint8_t* bytes = element(i);
  return bytes ? load_index(bytes, component_type_) : 0;
}

}  // namespace triptych
