// The buffer views of a glTF file, and what compresses them: EXT_meshopt_compression and Draco.
#include "base/error.hpp"
#include "model/import/byte_spool.hpp"
#include "model/import/import_gltf.hpp"

#include <algorithm>
#include <draco/compression/decode.h>
#include <meshoptimizer.h>

namespace triptych {

namespace {

/// A range of a buffer; Error (place) if it leaves the buffer.
GltfBuffer range_of(const GltfFile& gltf, int64_t index, uint64_t offset, uint64_t length,
                    const std::string& place) {
  if (index < 0 || static_cast<size_t>(index) >= gltf.buffers.size())
    fail(place, "names buffer {} of {}", index, gltf.buffers.size());
  const GltfBuffer& buffer = gltf.buffers[static_cast<size_t>(index)];
  if (!buffer.source) fail(place, "{}", buffer.missing.empty() ? "its buffer holds nothing" : buffer.missing);
  if (offset > buffer.size || length > buffer.size - offset)
    fail(place, "goes beyond its buffer of {} bytes", buffer.size);
  return {buffer.source, buffer.offset + offset, length};
}

/// The elements of a view that meshoptimizer compressed.
std::vector<std::byte> unpack_meshopt(const GltfFile& gltf, const GltfMeshopt& packed,
                                      const std::string& place) {
  const std::vector<std::byte> bytes =
      read_gltf_bytes(range_of(gltf, packed.buffer, packed.offset, packed.length, place));
  // A block of up to 256 elements takes a byte for each of an element's bytes at least.
  constexpr uint64_t most = 512;
  const bool vertices = packed.mode == "ATTRIBUTES";
  const bool right_stride = vertices ? packed.stride > 0 && packed.stride <= 256 && packed.stride % 4 == 0
                                     : packed.stride == 2 || packed.stride == 4;
  if (!right_stride || packed.count > (bytes.size() + 256) * most / packed.stride)
    fail(place, "EXT_meshopt_compression: {} elements of {} bytes cannot be in {} bytes", packed.count,
         packed.stride, bytes.size());
  std::vector<std::byte> elements(packed.count * packed.stride);
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int result = -1;
  if (vertices) {
    result = meshopt_decodeVertexBuffer(elements.data(), packed.count, packed.stride, data, bytes.size());
  } else if (packed.mode == "TRIANGLES" && packed.count % 3 == 0) {
    result = meshopt_decodeIndexBuffer(elements.data(), packed.count, packed.stride, data, bytes.size());
  } else if (packed.mode == "INDICES") {
    result = meshopt_decodeIndexSequence(elements.data(), packed.count, packed.stride, data, bytes.size());
  }
  if (result != 0) fail(place, "EXT_meshopt_compression: its data cannot be unpacked");
  if (packed.filter == "OCTAHEDRAL" && (packed.stride == 4 || packed.stride == 8))
    meshopt_decodeFilterOct(elements.data(), packed.count, packed.stride);
  if (packed.filter == "QUATERNION" && packed.stride == 8)
    meshopt_decodeFilterQuat(elements.data(), packed.count, packed.stride);
  if (packed.filter == "EXPONENTIAL") meshopt_decodeFilterExp(elements.data(), packed.count, packed.stride);
  return elements;
}

}  // namespace

std::vector<std::byte> read_gltf_bytes(const GltfBuffer& range) {
  std::vector<std::byte> bytes(range.size);
  if (range.size > 0) SourceReader(range.source).read(range.offset, bytes);
  return bytes;
}

GltfBuffer gltf_view_bytes(const GltfFile& gltf, int64_t index, const std::string& place) {
  const auto& views = gltf.model.views;
  if (index < 0 || static_cast<size_t>(index) >= views.size())
    fail(place, "names buffer view {} of {}", index, views.size());
  const auto number = static_cast<size_t>(index);
  const GltfView& view = views[number];
  const std::string view_place = fmt::format("{} buffer view {}", place, index);
  if (!view.meshopt) return range_of(gltf, view.buffer, view.offset, view.length, view_place);
  const auto found = gltf.unpacked_views.find(number);
  if (found != gltf.unpacked_views.end()) return found->second;
  const std::vector<std::byte> elements = unpack_meshopt(gltf, *view.meshopt, view_place);
  UnpackedBytes unpacked(view_place, gltf.options.temporary_folder);
  unpacked.append(elements);
  return gltf.unpacked_views[number] = {unpacked.take(), 0, elements.size()};
}

namespace {

/// Three components of each point, or as many as there are. Error (place) where they cannot be read; what:
/// what they are.
std::vector<glm::dvec3> values_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                                  const std::string& place, const char* what) {
  std::vector<glm::dvec3> values;
  for (uint32_t i = 0; i < mesh.num_points(); ++i) {
    glm::dvec3 value{0};
    const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(i));
    if (index.value() >= attribute.size() || !attribute.ConvertValue<double, 3>(index, &value.x))
      fail(place, "its {} cannot be read", what);
    values.push_back(value);
  }
  return values;
}

/// What colours of this type are divided by, where they are not normalized while they are converted.
double largest_channel(const draco::PointAttribute& attribute) {
  if (attribute.normalized()) return 1;
  return attribute.data_type() == draco::DT_UINT8    ? 255
         : attribute.data_type() == draco::DT_UINT16 ? 65535
                                                     : 1;
}

}  // namespace

GltfDracoMesh unpack_draco(const GltfFile& gltf, const GltfDraco& packed, int64_t set,
                           const std::string& file_place) {
  const std::string place = file_place + ": KHR_draco_mesh_compression";
  const std::vector<std::byte> bytes = read_gltf_bytes(gltf_view_bytes(gltf, packed.view, place));
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok())
    fail(place, "its data cannot be unpacked ({})", decoded.status().error_msg_string().substr(0, 80));
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  const draco::PointAttribute* attribute =
      packed.positions >= 0 ? mesh->GetAttributeByUniqueId(static_cast<uint32_t>(packed.positions))
                            : mesh->GetNamedAttribute(draco::GeometryAttribute::POSITION);
  if (!attribute || attribute->num_components() != 3) fail(place, "its data hold no positions");
  const std::vector<glm::dvec3> positions = values_of(*mesh, *attribute, place, "positions");
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < mesh->num_faces(); ++i) {
    for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(i))) indices.push_back(corner.value());
  }
  const auto source_of = [&](auto values) {
    UnpackedBytes unpacked(place, gltf.options.temporary_folder);
    unpacked.append(std::as_bytes(values));
    return unpacked.take();
  };
  const auto table_of = [&](const std::vector<glm::dvec3>& values) {
    return PositionTable{
        .source = source_of(std::span(values)),
        .count = values.size(),
        .stride = sizeof(glm::dvec3),
        .fields = {{{0, ScalarType::float64}, {8, ScalarType::float64}, {16, ScalarType::float64}}}};
  };
  GltfDracoMesh result{
      {source_of(std::span(indices)), 0, indices.size(), sizeof(uint32_t), ScalarType::uint32},
      table_of(positions)};
  const draco::PointAttribute* colors =
      packed.colors >= 0 ? mesh->GetAttributeByUniqueId(static_cast<uint32_t>(packed.colors)) : nullptr;
  if (colors && colors->num_components() >= 3) {
    result.colors = ColorTable{.values = table_of(values_of(*mesh, *colors, place, "colours")),
                               .scale = glm::dvec3(1 / largest_channel(*colors)),
                               .linear = true};
  }
  const draco::PointAttribute* normals =
      packed.normals >= 0 ? mesh->GetAttributeByUniqueId(static_cast<uint32_t>(packed.normals)) : nullptr;
  if (normals && normals->num_components() == 3)
    result.normals = table_of(values_of(*mesh, *normals, place, "normals"));
  const auto id = set < 0 ? packed.attributes.end() : packed.attributes.find(fmt::format("TEXCOORD_{}", set));
  const draco::PointAttribute* places = id == packed.attributes.end() || id->second < 0
                                            ? nullptr
                                            : mesh->GetAttributeByUniqueId(static_cast<uint32_t>(id->second));
  if (places && places->num_components() == 2)
    result.coordinates = table_of(values_of(*mesh, *places, place, "texture coordinates"));
  return result;
}

}  // namespace triptych
