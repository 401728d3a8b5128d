#include "samples/gltf_writer.hpp"

#include <cmath>

namespace triptych {
namespace {

using Json = nlohmann::ordered_json;

constexpr int component_byte = 5121, component_float = 5126, component_unsigned = 5125,
              target_vertices = 34962, target_indices = 34963;

std::filesystem::path made(const std::filesystem::path& folder) {
  make_folder(folder);
  return folder;
}

}  // namespace

GltfWriter::GltfWriter(const std::filesystem::path& folder, const std::string& generator, std::string name)
    : folder_(made(folder)), name_(std::move(name)), buffer_(folder_ / (name_ + ".bin")) {
  gltf_["asset"] = {{"version", "2.0"}, {"generator", generator}};
  gltf_["scene"] = 0;
  gltf_["scenes"] = Json::array({{{"nodes", Json::array()}}});
  for (const char* part : {"nodes", "meshes", "materials", "accessors", "bufferViews", "buffers"})
    gltf_[part] = Json::array();
}

size_t GltfWriter::add_accessor(std::span<const std::byte> bytes, size_t count, bool indices) {
  gltf_["bufferViews"].push_back({{"buffer", 0},
                                  {"byteOffset", buffer_.size()},
                                  {"byteLength", bytes.size()},
                                  {"target", indices ? target_indices : target_vertices}});
  buffer_.write(bytes);
  gltf_["accessors"].push_back({{"bufferView", gltf_["bufferViews"].size() - 1},
                                {"componentType", indices ? component_unsigned : component_float},
                                {"count", count},
                                {"type", indices ? "SCALAR" : "VEC3"}});
  return gltf_["accessors"].size() - 1;
}

size_t GltfWriter::texture(const std::string& image) {
  const auto [found, added] = textures_.try_emplace(image, textures_.size());
  if (added) {
    gltf_["images"].push_back({{"uri", image}});
    gltf_["textures"].push_back({{"source", found->second}});
  }
  return found->second;
}

size_t GltfWriter::material(const MeshPart& part) {
  // Four digits are more than an eight-bit picture can show, and equal colours become one material.
  std::array<uint32_t, 8> key{};
  const auto digits = [](double value) { return static_cast<uint32_t>(std::lround(value * 10000)); };
  for (int i = 0; i < 3; ++i) {
    key[static_cast<size_t>(i)] = digits(part.colour[i]);
    key[static_cast<size_t>(4 + i)] = digits(part.emission[i]);
  }
  key[3] = digits(part.alpha);
  key[7] = part.cut_out;
  const auto [found, added] =
      materials_.try_emplace(Key(key, {part.texture, part.emission_texture}), materials_.size());
  if (!added) return found->second;
  Json material = {
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {key[0] / 10000.0, key[1] / 10000.0, key[2] / 10000.0, key[3] / 10000.0}},
        {"metallicFactor", 0.0}}}};
  if (!part.texture.empty())
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture(part.texture)}};
  if (part.emission != glm::dvec3(0))
    material["emissiveFactor"] = {key[4] / 10000.0, key[5] / 10000.0, key[6] / 10000.0};
  if (!part.emission_texture.empty())
    material["emissiveTexture"] = {{"index", texture(part.emission_texture)}};
  if (part.alpha < 1) material["alphaMode"] = "BLEND";
  if (part.cut_out) material["alphaMode"] = "MASK";
  gltf_["materials"].push_back(std::move(material));
  return found->second;
}

Json GltfWriter::add_primitive(const MeshPart& part) {
  glm::vec3 low(part.positions.at(0)), high(low);
  for (const auto& position : part.positions) {
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
  const size_t positions =
      add_accessor(std::as_bytes(std::span<const glm::vec3>(part.positions)), part.positions.size(), false);
  gltf_["accessors"].back()["min"] = {low.x, low.y, low.z};
  gltf_["accessors"].back()["max"] = {high.x, high.y, high.z};
  const size_t indices =
      add_accessor(std::as_bytes(std::span<const uint32_t>(part.indices)), part.indices.size(), true);
  Json primitive = {
      {"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", material(part)}};
  if (!part.vertex_colours.empty()) {
    const size_t colours =
        add_accessor(std::as_bytes(std::span(part.vertex_colours)), part.vertex_colours.size(), false);
    Json& accessor = gltf_["accessors"].back();
    accessor["componentType"] = component_byte;
    accessor["normalized"] = true;
    accessor["type"] = "VEC4";
    primitive["attributes"]["COLOR_0"] = colours;
  }
  if (!part.normals.empty()) {
    primitive["attributes"]["NORMAL"] =
        add_accessor(std::as_bytes(std::span<const glm::vec3>(part.normals)), part.normals.size(), false);
  }
  if (!part.texture_places.empty()) {
    const size_t places =
        add_accessor(std::as_bytes(std::span(part.texture_places)), part.texture_places.size(), false);
    gltf_["accessors"].back()["type"] = "VEC2";
    primitive["attributes"]["TEXCOORD_0"] = places;
  }
  return primitive;
}

size_t GltfWriter::add_mesh(const std::string& name, const std::vector<MeshPart>& parts) {
  Json primitives = Json::array();
  for (const MeshPart& part : parts) primitives.push_back(add_primitive(part));
  gltf_["meshes"].push_back({{"name", name}, {"primitives", std::move(primitives)}});
  return gltf_["meshes"].size() - 1;
}

size_t GltfWriter::add_mesh(const std::string& name, size_t count,
                            const std::function<MeshPart(size_t)>& make_part) {
  Json primitives = Json::array();
  for (size_t i = 0; i < count; ++i) primitives.push_back(add_primitive(make_part(i)));
  gltf_["meshes"].push_back({{"name", name}, {"primitives", std::move(primitives)}});
  return gltf_["meshes"].size() - 1;
}

void GltfWriter::add_node(const std::string& name, size_t mesh, const glm::dmat4& transform,
                          std::optional<size_t> parent) {
  Json node = {{"name", name}, {"mesh", mesh}};
  if (transform != glm::dmat4(1)) {
    Json& matrix = node["matrix"] = Json::array();
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) matrix.push_back(transform[column][row]);
  }
  add_node(std::move(node), parent);
}

size_t GltfWriter::add_point_light(const std::string& name, const glm::dvec3& colour, double candela) {
  constexpr const char* extension = "KHR_lights_punctual";
  Json& lights = gltf_["extensions"][extension]["lights"];
  if (lights.is_null()) gltf_["extensionsUsed"].push_back(extension);
  lights.push_back(
      {{"name", name}, {"type", "point"}, {"color", {colour.r, colour.g, colour.b}}, {"intensity", candela}});
  return lights.size() - 1;
}

void GltfWriter::add_light_node(size_t light, const glm::dvec3& position, std::optional<size_t> parent) {
  add_node({{"translation", {position.x, position.y, position.z}},
            {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}},
           parent);
}

void GltfWriter::add_node(Json node, std::optional<size_t> parent) {
  Json& siblings = parent ? gltf_["nodes"][*parent]["children"] : gltf_["scenes"][0]["nodes"];
  siblings.push_back(gltf_["nodes"].size());
  gltf_["nodes"].push_back(std::move(node));
}

size_t GltfWriter::add_parent(const std::string& name, const glm::dvec3& translation) {
  const size_t number = gltf_["nodes"].size();
  gltf_["scenes"][0]["nodes"].push_back(number);
  gltf_["nodes"].push_back({{"name", name},
                            {"translation", {translation.x, translation.y, translation.z}},
                            {"children", Json::array()}});
  return number;
}

size_t GltfWriter::add_moving_node(const std::string& name, size_t mesh, const glm::dvec3& translation,
                                   std::optional<size_t> parent) {
  add_node(name, mesh, glm::dmat4(1), parent);
  gltf_["nodes"].back()["translation"] = {translation.x, translation.y, translation.z};
  return gltf_["nodes"].size() - 1;
}

void GltfWriter::animate(size_t node, const std::string& path, const std::vector<float>& times,
                         const std::vector<float>& values) {
  const auto add = [&](const std::vector<float>& numbers, const char* type) {
    const size_t accessor = add_accessor(std::as_bytes(std::span(numbers)), times.size(), false);
    gltf_["bufferViews"].back().erase("target");
    gltf_["accessors"].back()["type"] = type;
    return accessor;
  };
  const size_t input = add(times, "SCALAR");
  gltf_["accessors"].back()["min"] = {times.front()};
  gltf_["accessors"].back()["max"] = {times.back()};
  const size_t output = add(values, path == "rotation" ? "VEC4" : "VEC3");
  if (!gltf_.contains("animations"))
    gltf_["animations"] = Json::array({{{"channels", Json::array()}, {"samplers", Json::array()}}});
  Json& animation = gltf_["animations"][0];
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
  animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
}

void GltfWriter::set_attribution(const std::string& copyright, Json extras) {
  gltf_["asset"]["copyright"] = copyright;
  gltf_["asset"]["extras"] = std::move(extras);
}

void GltfWriter::finish() {
  gltf_["buffers"].push_back({{"uri", name_ + ".bin"}, {"byteLength", buffer_.size()}});
  buffer_.commit();
  write_file(folder_ / (name_ + ".gltf"), gltf_.dump() + "\n");
}

}  // namespace triptych
