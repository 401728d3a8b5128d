// A small glTF document for the tests of its importer.
#pragma once

#include "import_support.hpp"

#include <nlohmann/json.hpp>

namespace triptych::test {

using nlohmann::json;

/// Four corners of a square as floats (48 bytes), then indices 0 1 2 2 1 3 as 16 bits (12 bytes).
inline std::string square_bytes() {
  std::string bytes;
  for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f}) append(bytes, value);
  for (const int index : {0, 1, 2, 2, 1, 3}) append(bytes, static_cast<uint16_t>(index));
  return bytes;
}

/// A glTF document of one square mesh on one node; its buffer is square.bin.
inline json square() {
  return json::parse(R"({
    "asset": {"version": "2.0"},
    "buffers": [{"byteLength": 60, "uri": "square.bin"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 0.75]}}],
    "meshes": [{"name": "square", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "nodes": [{"mesh": 0}],
    "scenes": [{"nodes": [0]}],
    "scene": 0})");
}

inline Model import_json(const json& document) {
  write_model("square.bin", square_bytes());
  return import_text("a.gltf", document.dump());
}

inline std::string json_error(const json& document) {
  write_model("square.bin", square_bytes());
  return import_error("a.gltf", document.dump());
}

inline std::string glb(json document, std::string bytes) {
  document["buffers"] = {{{"byteLength", bytes.size()}}};
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  bytes.resize((bytes.size() + 3) / 4 * 4);
  std::string file = "glTF";
  append(file, 2u);
  append(file, static_cast<uint32_t>(28 + text.size() + bytes.size()));
  append(file, static_cast<uint32_t>(text.size()));
  file += "JSON" + text;
  append(file, static_cast<uint32_t>(bytes.size()));
  return file + std::string("BIN\0", 4) + bytes;
}

}  // namespace triptych::test
