#include "scene/surface_material.hpp"

#include "base/bytes.hpp"
#include "scene/skeleton.hpp"

namespace triptych {

std::vector<std::byte> encode_materials(const Skeleton& skeleton) {
  if (skeleton.materials.empty()) return {};
  ByteWriter writer;
  writer.write(static_cast<uint32_t>(skeleton.materials.size()));
  writer.write(static_cast<uint32_t>(skeleton.textures.size()));
  writer.write_all(std::span<const SurfaceMaterial>(skeleton.materials));
  for (const Texture& texture : skeleton.textures) {
    writer.write(texture.width);
    writer.write(texture.height);
    writer.write_all(std::span<const TextureLevel>(texture.levels));
  }
  return std::move(writer.bytes());
}

void decode_materials(std::span<const std::byte> bytes, uint64_t texel_bytes, const std::string& place,
                      Skeleton& skeleton) {
  ByteReader reader(bytes, place);
  const auto material_count = reader.read<uint32_t>(), texture_count = reader.read<uint32_t>();
  if (material_count != skeleton.palette.size())
    fail(place, "has {} materials of {} colours", material_count, skeleton.palette.size());
  // Raw bytes first: a truth value of another number than 0 and 1 is none.
  const auto raw = reader.read_all<std::array<uint8_t, sizeof(SurfaceMaterial)>>(material_count);
  for (const auto& material : raw) {
    SurfaceMaterial read;
    constexpr size_t wraps = offsetof(SurfaceMaterial, sampler);
    if (material[wraps] > 2 || material[wraps + 1] > 2 || material[wraps + 2] > 1)
      fail(place, "has a sampler of an unknown kind");
    std::memcpy(&read, material.data(), sizeof(read));
    for (const uint32_t texture : {read.texture, read.emission_texture}) {
      if (texture != SurfaceMaterial::no_texture && texture >= texture_count)
        fail(place, "names texture {} of {}", texture, texture_count);
    }
    if (read.cutoff > 0 && read.texture == SurfaceMaterial::no_texture)
      fail(place, "has holes in a surface without a texture");
    skeleton.materials.push_back(read);
  }
  for (uint32_t i = 0; i < texture_count; ++i) {
    Texture texture{reader.read<uint32_t>(), reader.read<uint32_t>(), {}};
    if (texture.width < 1 || texture.height < 1 || texture.width > max_texture_side ||
        texture.height > max_texture_side)
      fail(place, "texture {} has {}x{} texels", i, texture.width, texture.height);
    texture.levels = reader.read_all<TextureLevel>(texture_levels(texture.width, texture.height));
    for (const TextureLevel& level : texture.levels) {
      if (level.offset > texel_bytes || level.size > texel_bytes - level.offset)
        fail(place, "texture {} lies outside the section TEXL", i);
    }
    skeleton.textures.push_back(std::move(texture));
  }
  reader.expect_end();
}

}  // namespace triptych
