#include "launch/glb_textures.hpp"

#include <algorithm>
#include <assimp/material.h>
#include <cmath>
#include <cstdint>
#include <fmt/core.h>
#include <string_view>

namespace triptych {

namespace {

/// With everything but letters, digits and what separates folders and extensions as percents.
std::string uri_of(std::string_view path) {
  std::string uri;
  for (const char letter : path) {
    const bool plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                       (letter >= '0' && letter <= '9') || letter == '.' || letter == '/' || letter == '_' ||
                       letter == '-';
    uri += plain ? std::string(1, letter) : fmt::format("%{:02X}", static_cast<uint8_t>(letter));
  }
  return uri;
}

std::string base64(const uint8_t* bytes, size_t count) {
  static constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((count + 2) / 3 * 4);
  for (size_t i = 0; i < count; i += 3) {
    const size_t here = std::min<size_t>(3, count - i);
    uint32_t word = 0;
    for (size_t k = 0; k < 3; ++k) word = word << 8 | (k < here ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k) text += k <= here ? letters[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

int wrap_of(const aiMaterial& material, aiTextureType type, bool across) {
  constexpr int repeat = 10497, clamp = 33071, mirrored = 33648;
  int mode = aiTextureMapMode_Wrap;
  if (across)
    material.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), mode);
  else
    material.Get(AI_MATKEY_MAPPINGMODE_V(type, 0), mode);
  return mode == aiTextureMapMode_Mirror                                    ? mirrored
         : mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal ? clamp
                                                                            : repeat;
}

/// The first texture of a type; empty where it has none, or one without a name, as X3D allows.
std::string path_of(const aiMaterial& material, aiTextureType type) {
  aiString path;
  return material.GetTexture(type, 0, &path) == aiReturn_SUCCESS ? path.C_Str() : "";
}

}  // namespace

void GlbTextures::add(unsigned number, nlohmann::json& target) {
  const aiMaterial& material = *scene_.mMaterials[number];
  aiTextureType type = aiTextureType_BASE_COLOR;
  std::string path = path_of(material, type);
  if (path.empty()) {
    type = aiTextureType_DIFFUSE;
    path = path_of(material, type);
  }
  const std::string opacity = path_of(material, aiTextureType_OPACITY);
  if (!opacity.empty() && opacity != path) ++notes_["textures of opacity alone are not drawn"];
  if (path.empty()) return;
  const auto source = image(path);
  if (!source) return;
  Use use;
  int channel = 0;
  if (material.Get(AI_MATKEY_UVWSRC(type, 0), channel) == aiReturn_SUCCESS && channel >= 0)
    use.channel = static_cast<unsigned>(channel);
  material.Get(AI_MATKEY_UVTRANSFORM(type, 0), use.transform);
  const aiUVTransform& transform = use.transform;
  for (const float value :
       {transform.mTranslation.x, transform.mTranslation.y, transform.mScaling.x, transform.mScaling.y}) {
    if (!std::isfinite(value)) use.transform = aiUVTransform();
  }
  if (std::abs(transform.mRotation) > 0) ++notes_["turns of textures are not applied"];
  uses_[number] = use;
  const nlohmann::json sampler = {{"wrapS", wrap_of(material, type, true)},
                                  {"wrapT", wrap_of(material, type, false)}};
  auto found = std::ranges::find(samplers_, sampler);
  const auto at = static_cast<size_t>(found - samplers_.begin());
  if (found == samplers_.end()) samplers_.push_back(sampler);
  nlohmann::json& surface = target["pbrMetallicRoughness"];
  surface["baseColorTexture"] = {{"index", textures_.size()}};
  // A texture replaces the colour that a material has beside it: in COLLADA and FBX that is a rest.
  for (size_t k = 0; k < 3; ++k) surface["baseColorFactor"][k] = 1.0f;
  textures_.push_back({{"source", *source}, {"sampler", at}});
  if (!opacity.empty() && opacity == path) target["alphaMode"] = "MASK";
}

/// The image of that name, or that the file holds.
std::optional<size_t> GlbTextures::image(const std::string& path) {
  const auto found = std::ranges::find(known_, path, &std::pair<std::string, size_t>::first);
  if (found != known_.end()) return found->second;
  nlohmann::json entry = {{"uri", uri_of(path)}};
  if (const aiTexture* const held = scene_.GetEmbeddedTexture(path.c_str())) {
    if (held->mHeight != 0) {
      ++notes_["images that the file holds texel by texel are not drawn"];
      return std::nullopt;
    }
    entry = {{"name", path},
             {"uri", "data:application/octet-stream;base64," +
                         base64(reinterpret_cast<const uint8_t*>(held->pcData), held->mWidth)}};
  }
  images_.push_back(std::move(entry));
  known_.emplace_back(path, images_.size() - 1);
  return images_.size() - 1;
}

void GlbTextures::write_to(nlohmann::json& document) const {
  if (textures_.empty()) return;
  document["images"] = images_;
  document["textures"] = textures_;
  document["samplers"] = samplers_;
}

const GlbTextures::Use* GlbTextures::use_of(const aiMesh& mesh) const {
  if (mesh.mMaterialIndex >= uses_.size() || !uses_[mesh.mMaterialIndex]) return nullptr;
  const Use& use = *uses_[mesh.mMaterialIndex];
  return use.channel < AI_MAX_NUMBER_OF_TEXTURECOORDS && mesh.HasTextureCoords(use.channel) ? &use : nullptr;
}

glm::vec2 GlbTextures::place(const aiMesh& mesh, unsigned vertex) const {
  const Use& use = *use_of(mesh);
  const aiVector3D& own = mesh.mTextureCoords[use.channel][vertex];
  // Assimp counts from the lower left corner.
  return {own.x * use.transform.mScaling.x + use.transform.mTranslation.x,
          1 - (own.y * use.transform.mScaling.y + use.transform.mTranslation.y)};
}

}  // namespace triptych
