#include "model/import/import_gltf_document.hpp"

#include "base/error.hpp"
#include "base/parse_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace triptych {

namespace {

using Json = nlohmann::json;

/// Reads members of objects; counts those of the wrong type.
class MemberReader {
 public:
  explicit MemberReader(std::map<std::string, uint64_t>& misread) : misread_(misread) {}

  /// The member, or null where there is none.
  static const Json* find(const Json& object, const char* name) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(name);
    return found == object.end() ? nullptr : &*found;
  }

  int64_t integer(const Json& object, const char* name, int64_t otherwise) {
    const Json* value = find(object, name);
    return value ? whole(*value, name, otherwise) : otherwise;
  }
  /// Whole numbers may be written as 5.0.
  int64_t whole(const Json& value, const char* name, int64_t otherwise) {
    if (value.is_number_unsigned() && value.get<uint64_t>() <= uint64_t{1} << 62) return value.get<int64_t>();
    if (value.is_number_integer() && !value.is_number_unsigned()) return value.get<int64_t>();
    if (value.is_number_float() && std::abs(value.get<double>()) < 1e15 &&
        value.get<double>() == std::floor(value.get<double>()))
      return static_cast<int64_t>(value.get<double>());
    ++misread_[name];
    return otherwise;
  }
  /// What is no size is one that no buffer has, so that its use is an error.
  uint64_t size(const Json& object, const char* name) {
    const Json* value = find(object, name);
    if (!value) return 0;
    if (value->is_number_unsigned()) return value->get<uint64_t>();
    const int64_t number = whole(*value, name, -1);
    return number < 0 ? ~uint64_t{0} : static_cast<uint64_t>(number);
  }
  std::string text(const Json& object, const char* name) {
    const Json* value = find(object, name);
    if (!value) return "";
    if (value->is_string()) return value->get<std::string>();
    ++misread_[name];
    return "";
  }
  bool flag(const Json& object, const char* name, bool otherwise) {
    const Json* value = find(object, name);
    if (!value) return otherwise;
    if (value->is_boolean()) return value->get<bool>();
    ++misread_[name];
    return otherwise;
  }
  /// The list's entries; an empty one where there is none.
  const Json& list(const Json& object, const char* name) {
    static const Json none = Json::array();
    const Json* value = find(object, name);
    if (!value) return none;
    if (value->is_array()) return *value;
    ++misread_[name];
    return none;
  }
  std::vector<int64_t> integers(const Json& object, const char* name) {
    std::vector<int64_t> numbers;
    for (const Json& value : list(object, name)) numbers.push_back(whole(value, name, -1));
    return numbers;
  }
  std::vector<double> numbers(const Json& object, const char* name) {
    std::vector<double> numbers;
    for (const Json& value : list(object, name)) {
      if (!value.is_number()) ++misread_[name];
      numbers.push_back(value.is_number() ? value.get<double>() : std::nan(""));
    }
    return numbers;
  }
  double number(const Json& object, const char* name, double otherwise) {
    const Json* value = find(object, name);
    if (!value) return otherwise;
    if (value->is_number()) return value->get<double>();
    ++misread_[name];
    return otherwise;
  }
  std::map<std::string, int64_t> references(const Json& object, const char* name) {
    std::map<std::string, int64_t> references;
    const Json* value = find(object, name);
    if (!value) return references;
    if (!value->is_object()) ++misread_[name];
    if (value->is_object()) {
      for (const auto& [key, number] : value->items()) references[key] = whole(number, name, -1);
    }
    return references;
  }
  static const Json* extension(const Json& object, const char* name) {
    const Json* extensions = find(object, "extensions");
    return extensions ? find(*extensions, name) : nullptr;
  }

 private:
  std::map<std::string, uint64_t>& misread_;
};

class DocumentParser {
 public:
  explicit DocumentParser(GltfDocument& document) : document_(document), members_(document.misread) {}

  void parse(const Json& json) {
    if (const Json* asset = MemberReader::find(json, "asset"))
      document_.version = members_.text(*asset, "version");
    for (const Json& entry : members_.list(json, "bufferViews")) document_.views.push_back(view(entry));
    for (const Json& entry : members_.list(json, "accessors")) document_.accessors.push_back(accessor(entry));
    for (const Json& entry : members_.list(json, "materials")) document_.materials.push_back(material(entry));
    for (const Json& entry : members_.list(json, "textures")) document_.textures.push_back(texture(entry));
    for (const Json& entry : members_.list(json, "samplers")) document_.samplers.push_back(sampler(entry));
    for (const Json& entry : members_.list(json, "meshes")) document_.meshes.push_back(mesh(entry));
    for (const Json& entry : members_.list(json, "nodes")) document_.nodes.push_back(node(entry));
    for (const Json& entry : members_.list(json, "skins"))
      document_.skins.push_back(
          {members_.integers(entry, "joints"), members_.integer(entry, "inverseBindMatrices", -1)});
    if (const Json* punctual = MemberReader::extension(json, "KHR_lights_punctual")) {
      for (const Json& entry : members_.list(*punctual, "lights")) document_.lights.push_back(light(entry));
    }
    for (const Json& entry : members_.list(json, "scenes"))
      document_.scenes.push_back(members_.integers(entry, "nodes"));
    document_.default_scene = members_.integer(json, "scene", -1);
    for (const Json& entry : members_.list(json, "extensionsRequired")) {
      if (entry.is_string()) document_.required_extensions.push_back(entry.get<std::string>());
    }
    for (const Json& entry : members_.list(json, "animations"))
      document_.animations.push_back(animation(entry));
  }

 private:
  GltfView view(const Json& entry) {
    GltfView view{members_.integer(entry, "buffer", -1),
                  members_.size(entry, "byteOffset"),
                  members_.size(entry, "byteLength"),
                  members_.size(entry, "byteStride"),
                  {}};
    const Json* meshopt = MemberReader::extension(entry, "EXT_meshopt_compression");
    if (!meshopt) meshopt = MemberReader::extension(entry, "KHR_meshopt_compression");
    if (meshopt) {
      view.meshopt = {members_.integer(*meshopt, "buffer", -1), members_.size(*meshopt, "byteOffset"),
                      members_.size(*meshopt, "byteLength"),    members_.size(*meshopt, "byteStride"),
                      members_.size(*meshopt, "count"),         members_.text(*meshopt, "mode"),
                      members_.text(*meshopt, "filter")};
    }
    return view;
  }

  GltfAccessorEntry accessor(const Json& entry) {
    GltfAccessorEntry accessor{members_.integer(entry, "bufferView", -1),
                               members_.size(entry, "byteOffset"),
                               members_.size(entry, "count"),
                               static_cast<int>(members_.integer(entry, "componentType", 0) & 0xffff),
                               members_.text(entry, "type"),
                               members_.flag(entry, "normalized", false),
                               {}};
    const Json* sparse = MemberReader::find(entry, "sparse");
    if (!sparse) return accessor;
    static const Json none = Json::object();
    const Json* indices = MemberReader::find(*sparse, "indices");
    const Json* values = MemberReader::find(*sparse, "values");
    indices = indices ? indices : &none;
    values = values ? values : &none;
    accessor.sparse = {members_.size(*sparse, "count"),
                       members_.integer(*indices, "bufferView", -1),
                       members_.integer(*values, "bufferView", -1),
                       members_.size(*indices, "byteOffset"),
                       members_.size(*values, "byteOffset"),
                       static_cast<int>(members_.integer(*indices, "componentType", 0) & 0xffff)};
    return accessor;
  }

  GltfTextureUse texture_use(const Json& entry) {
    GltfTextureUse use{members_.integer(entry, "index", -1), members_.integer(entry, "texCoord", 0), {}};
    const Json* transform = MemberReader::extension(entry, "KHR_texture_transform");
    if (!transform) return use;
    const auto pair = [&](const char* name, std::array<double, 2>& values) {
      const std::vector<double> numbers = members_.numbers(*transform, name);
      for (size_t i = 0; i < std::min(numbers.size(), values.size()); ++i) values[i] = numbers[i];
    };
    pair("offset", use.transform.offset);
    pair("scale", use.transform.scale);
    use.transform.rotation = members_.number(*transform, "rotation", 0);
    use.coordinates = members_.integer(*transform, "texCoord", use.coordinates);
    return use;
  }

  GltfTexture texture(const Json& entry) {
    GltfTexture texture{members_.integer(entry, "source", -1), members_.integer(entry, "sampler", -1)};
    if (const Json* webp = MemberReader::extension(entry, "EXT_texture_webp"))
      texture.image = members_.integer(*webp, "source", texture.image);
    // Where there is nothing else its KTX2 image is named, so that what is wrong with that is said.
    const Json* basisu = MemberReader::extension(entry, "KHR_texture_basisu");
    if (texture.image < 0 && basisu != nullptr) texture.image = members_.integer(*basisu, "source", -1);
    return texture;
  }

  GltfSampler sampler(const Json& entry) {
    const GltfSampler usual;
    return {members_.integer(entry, "wrapS", usual.wrap_u), members_.integer(entry, "wrapT", usual.wrap_v),
            members_.integer(entry, "magFilter", usual.magnify)};
  }

  GltfMaterial material(const Json& entry) {
    GltfMaterial material;
    const auto take_color = [&](const Json& from, const char* factor, const char* texture) {
      const std::vector<double> color = members_.numbers(from, factor);
      for (size_t i = 0; i < std::min<size_t>(color.size(), 4); ++i)
        material.base_color[i] = std::isfinite(color[i]) ? std::clamp(color[i], 0.0, 1.0) : 1.0;
      if (const Json* use = MemberReader::find(from, texture)) material.base = texture_use(*use);
    };
    if (const Json* rough = MemberReader::find(entry, "pbrMetallicRoughness"))
      take_color(*rough, "baseColorFactor", "baseColorTexture");
    if (const Json* glossy = MemberReader::extension(entry, "KHR_materials_pbrSpecularGlossiness")) {
      material.base_color = {1, 1, 1, 1};
      take_color(*glossy, "diffuseFactor", "diffuseTexture");
    }
    double strength = 1;
    if (const Json* strong = MemberReader::extension(entry, "KHR_materials_emissive_strength"))
      strength = members_.number(*strong, "emissiveStrength", 1);
    const std::vector<double> emission = members_.numbers(entry, "emissiveFactor");
    for (size_t i = 0; i < std::min<size_t>(emission.size(), 3); ++i)
      material.emission[i] = std::isfinite(emission[i] * strength) ? emission[i] * strength : 0.0;
    if (const Json* use = MemberReader::find(entry, "emissiveTexture")) material.emissive = texture_use(*use);
    const std::string alpha = members_.text(entry, "alphaMode");
    if (alpha == "MASK") material.alpha = GltfAlpha::mask;
    if (alpha == "BLEND") material.alpha = GltfAlpha::blend;
    material.cutoff = members_.number(entry, "alphaCutoff", 0.5);
    return material;
  }

  GltfMesh mesh(const Json& entry) {
    GltfMesh mesh{members_.text(entry, "name"), {}};
    for (const Json& given : members_.list(entry, "primitives")) {
      GltfPrimitive primitive;
      primitive.attributes = members_.references(given, "attributes");
      primitive.indices = members_.integer(given, "indices", -1);
      primitive.material = members_.integer(given, "material", -1);
      primitive.mode = members_.integer(given, "mode", 4);
      primitive.has_targets = !members_.list(given, "targets").empty();
      if (const Json* draco = MemberReader::extension(given, "KHR_draco_mesh_compression")) {
        const auto attributes = members_.references(*draco, "attributes");
        const auto id_of = [&](const char* name) {
          const auto found = attributes.find(name);
          return found == attributes.end() ? -1 : found->second;
        };
        primitive.draco = {members_.integer(*draco, "bufferView", -1), id_of("POSITION"), id_of("COLOR_0"),
                           id_of("NORMAL"), attributes};
      }
      mesh.primitives.push_back(std::move(primitive));
    }
    return mesh;
  }

  GltfLight light(const Json& entry) {
    GltfLight light;
    light.type = members_.text(entry, "type");
    const std::vector<double> color = members_.numbers(entry, "color");
    for (size_t i = 0; i < std::min<size_t>(color.size(), 3); ++i) light.color[i] = color[i];
    light.intensity = members_.number(entry, "intensity", 1);
    light.range = members_.number(entry, "range", 0);
    if (const Json* spot = MemberReader::find(entry, "spot")) {
      light.inner_angle = members_.number(*spot, "innerConeAngle", light.inner_angle);
      light.outer_angle = members_.number(*spot, "outerConeAngle", light.outer_angle);
    }
    return light;
  }

  GltfAnimation animation(const Json& entry) {
    GltfAnimation animation;
    for (const Json& given : members_.list(entry, "channels")) {
      GltfAnimationChannel channel{members_.integer(given, "sampler", -1), -1, ""};
      if (const Json* target = MemberReader::find(given, "target")) {
        channel.node = members_.integer(*target, "node", -1);
        channel.path = members_.text(*target, "path");
      }
      animation.channels.push_back(std::move(channel));
    }
    for (const Json& given : members_.list(entry, "samplers")) {
      GltfAnimationSampler sampler{members_.integer(given, "input", -1),
                                   members_.integer(given, "output", -1),
                                   members_.text(given, "interpolation")};
      if (sampler.interpolation.empty()) sampler.interpolation = "LINEAR";
      animation.samplers.push_back(std::move(sampler));
    }
    return animation;
  }

  GltfNode node(const Json& entry) {
    GltfNode node;
    if (const Json* name = MemberReader::find(entry, "name"); name && name->is_string())
      node.name = name->get<std::string>();
    if (const Json* extras = MemberReader::find(entry, "extras"); extras && extras->is_object()) {
      for (const auto& [key, value] : extras->items()) {
        if (value.is_string()) node.extras.emplace_back(key, value.get<std::string>());
        if (value.is_number() || value.is_boolean()) node.extras.emplace_back(key, value.dump());
      }
    }
    node.mesh = members_.integer(entry, "mesh", -1);
    node.skin = members_.integer(entry, "skin", -1);
    if (const Json* punctual = MemberReader::extension(entry, "KHR_lights_punctual"))
      node.light = members_.integer(*punctual, "light", -1);
    node.children = members_.integers(entry, "children");
    node.matrix = members_.numbers(entry, "matrix");
    node.translation = members_.numbers(entry, "translation");
    node.rotation = members_.numbers(entry, "rotation");
    node.scale = members_.numbers(entry, "scale");
    if (const Json* visibility = MemberReader::extension(entry, "KHR_node_visibility"))
      node.visible = members_.flag(*visibility, "visible", true);
    if (const Json* instancing = MemberReader::extension(entry, "EXT_mesh_gpu_instancing"))
      node.instancing = members_.references(*instancing, "attributes");
    return node;
  }

  GltfDocument& document_;
  MemberReader members_;
};

}  // namespace

namespace {

/// Names in another encoding than UTF-8 are no reason to lose a file.
std::string in_ascii(std::string json) {
  std::replace_if(
      json.begin(), json.end(), [](char letter) { return static_cast<unsigned char>(letter) >= 0x80; }, '?');
  return json;
}

}  // namespace

std::string gltf_fault(const std::string& json) { return json_fault(in_ascii(json)); }

std::optional<GltfDocument> parse_gltf(const std::string& json, const std::string& place) {
  GltfDocument document;
  Json parsed = Json::parse(json, nullptr, false);
  if (parsed.is_discarded()) parsed = Json::parse(in_ascii(json), nullptr, false);
  if (parsed.is_discarded()) return std::nullopt;
  if (!parsed.is_object()) fail(place, "is not glTF: its JSON is no object");
  DocumentParser(document).parse(parsed);
  return document;
}

}  // namespace triptych
