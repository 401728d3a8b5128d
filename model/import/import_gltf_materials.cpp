// The materials of a glTF file as the model's.
#include "model/import/import_gltf.hpp"

#include <algorithm>
#include <limits>

namespace triptych {

namespace {

TextureWrap wrap_of(int64_t mode) {
  constexpr int64_t clamp = 33071, mirrored = 33648;
  return mode == clamp      ? TextureWrap::clamp
         : mode == mirrored ? TextureWrap::mirrored_repeat
                            : TextureWrap::repeat;
}

/// The texture that a material uses; null if it has none, or names one that is not there.
const GltfTexture* texture_of(const GltfFile& gltf, const GltfTextureUse& use, FileImport& target) {
  if (use.texture < 0) return nullptr;
  const auto& textures = gltf.model.textures;
  if (static_cast<size_t>(use.texture) < textures.size()) return &textures[static_cast<size_t>(use.texture)];
  target.warn("materials name a texture that is not there, and are drawn without");
  return nullptr;
}

TextureSampler sampler_of(const GltfFile& gltf, const GltfTexture& texture) {
  constexpr int64_t nearest = 9728;
  GltfSampler sampler;
  if (texture.sampler >= 0 && static_cast<size_t>(texture.sampler) < gltf.model.samplers.size())
    sampler = gltf.model.samplers[static_cast<size_t>(texture.sampler)];
  return {wrap_of(sampler.wrap_u), wrap_of(sampler.wrap_v), sampler.magnify == nearest};
}

/// Of what the texture's alpha says. Without a mode materials are opaque, whatever their colours say; masked
/// ones without a texture are there or not.
void set_alpha(const GltfMaterial& source, Material& material) {
  float& alpha = material.base_color[3];
  if (source.alpha == GltfAlpha::opaque) alpha = 1;
  if (source.alpha == GltfAlpha::mask) {
    const auto cutoff = static_cast<float>(source.cutoff);
    const bool shows = alpha >= cutoff;
    if (shows && material.texture != no_id && cutoff > 0) material.cutoff = cutoff / alpha;
    alpha = shows ? 1 : 0;
  }
  material.blends = source.alpha == GltfAlpha::blend && material.texture != no_id;
}

}  // namespace

GltfSurface read_gltf_material(const GltfFile& gltf, const GltfMaterial& source, GltfImages& images,
                               FileImport& target) {
  GltfSurface surface;
  Material& material = surface.material;
  for (int i = 0; i < 4; ++i)
    material.base_color[i] = static_cast<float>(source.base_color[static_cast<size_t>(i)]);
  for (int i = 0; i < 3; ++i)
    material.emission[i] = static_cast<float>(std::clamp(source.emission[static_cast<size_t>(i)], 0.0, 1.0));
  if (std::ranges::any_of(source.emission, [](double channel) { return channel > 1; })) {
    for (int i = 0; i < 3; ++i)
      material.emitted[i] = static_cast<float>(std::clamp(source.emission[static_cast<size_t>(i)], 0.0, 1e6));
  }
  const auto take = [&](const GltfTextureUse& use, uint32_t& image) {
    const GltfTexture* const texture = texture_of(gltf, use, target);
    if (texture == nullptr) return;
    const bool first = surface.coordinates < 0;
    if (!first && (surface.coordinates != use.coordinates || !(surface.transform == use.transform)))
      return target.warn(
          "emissive textures with other coordinates than the base colour's are not drawn: all of their "
          "surface is lit");
    image = images.image(texture->image);
    if (image == no_id || !first) return;
    surface.coordinates = use.coordinates;
    surface.transform = use.transform;
    material.sampler = sampler_of(gltf, *texture);
  };
  take(source.base, material.texture);
  if (source.emission != std::array<double, 3>{}) take(source.emissive, material.emission_texture);
  set_alpha(source, material);
  return surface;
}

}  // namespace triptych
