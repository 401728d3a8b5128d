#include "samples/kit/kit_files.hpp"

#include "base/file.hpp"
#include "samples/gltf_writer.hpp"
#include "samples/kit/kit_plan.hpp"

#include <array>
#include <cmath>
#include <fmt/core.h>
#include <span>

namespace triptych {

namespace {

using Json = nlohmann::ordered_json;

/// From sRGB's curve (IEC 61966-2-1) to linear light.
double linear(uint8_t displayed) {
  const double value = displayed / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

MeshPart part_of(const KitSolid& solid) {
  const KitMesh mesh = mesh_of(solid);
  MeshPart part;
  part.colour = {linear(solid.colour[0]), linear(solid.colour[1]), linear(solid.colour[2])};
  for (const glm::dvec3& position : mesh.positions) part.positions.emplace_back(turned_y_up(position));
  for (const auto& triangle : mesh.triangles)
    part.indices.insert(part.indices.end(), triangle.begin(), triangle.end());
  return part;
}

std::string dxf_layers() {
  std::string text = fmt::format("0\nTABLE\n2\nLAYER\n70\n{}\n", kit_solids().size());
  for (const KitSolid& solid : kit_solids()) {
    const int colour = solid.colour[0] << 16 | solid.colour[1] << 8 | solid.colour[2];
    text += fmt::format("0\nLAYER\n2\n{}\n70\n0\n62\n7\n420\n{}\n6\nCONTINUOUS\n", solid.name, colour);
  }
  return text + "0\nENDTAB\n";
}

std::string dxf_faces(const KitSolid& solid) {
  const KitMesh mesh = mesh_of(solid);
  std::string text;
  for (const auto& [a, b, c] : mesh.triangles) {
    text += fmt::format("0\n3DFACE\n8\n{}\n", solid.name);
    int code = 10;  // the fourth corner is the third again
    for (const uint32_t corner : {a, b, c, c}) {
      const glm::dvec3& point = mesh.positions[corner];
      text += fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n", code, point.x, code + 10, point.y, code + 20, point.z);
      ++code;
    }
  }
  return text;
}

}  // namespace

void write_kit_gltf(const std::filesystem::path& folder) {
  GltfWriter writer(folder, "triptych sample kit", "kit");
  std::vector<size_t> storeys;
  for (const KitStorey& storey : kit_storeys()) storeys.push_back(writer.add_parent(storey.name, {0, 0, 0}));
  for (const KitSolid& solid : kit_solids())
    writer.add_node(solid.name, writer.add_mesh(solid.name, {part_of(solid)}), glm::dmat4(1),
                    storeys[solid.storey]);
  writer.finish();
}

void write_kit_glb(const std::filesystem::path& folder) {
  Json document = Json::parse(read_text_file(folder / "kit.gltf"));
  document["buffers"][0].erase("uri");
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::vector<std::byte> buffer = read_file(folder / "kit.bin");  // of floats and 32-bit numbers
  constexpr uint32_t magic = 0x46546c67, version = 2, json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
  const auto text_size = static_cast<uint32_t>(text.size()), size = static_cast<uint32_t>(buffer.size());
  AtomicFile file(folder / "kit.glb");
  file.write(std::as_bytes(std::span<const uint32_t>(
      std::array<uint32_t, 5>{magic, version, 28 + text_size + size, text_size, json_chunk})));
  file.write(std::as_bytes(std::span<const char>(text)));
  file.write(std::as_bytes(std::span<const uint32_t>(std::array<uint32_t, 2>{size, binary_chunk})));
  file.write(buffer);
  file.commit();
}

void write_kit_dxf(const std::filesystem::path& folder) {
  constexpr int metres = 6;
  std::string text = fmt::format(
      "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1018\n9\n$INSUNITS\n70\n{}\n0\nENDSEC\n"
      "0\nSECTION\n2\nTABLES\n{}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n",
      metres, dxf_layers());
  for (const KitSolid& solid : kit_solids()) text += dxf_faces(solid);
  write_file(folder / "kit.dxf", text + "0\nENDSEC\n0\nEOF\n");
}

void write_kit_plan(const std::filesystem::path& file) {
  Json plan = {{"storeys", Json::array()}, {"solids", Json::array()}};
  for (const KitStorey& storey : kit_storeys())
    plan["storeys"].push_back({{"name", storey.name}, {"elevation", storey.elevation}});
  for (const KitSolid& solid : kit_solids()) {
    Json outline = Json::array(), colour = Json::array();
    for (const glm::dvec2& point : solid.outline) outline.push_back({point.x, point.y});
    for (const uint8_t channel : solid.colour) colour.push_back(channel / 255.0);
    plan["solids"].push_back({{"name", solid.name},
                              {"storey", solid.storey},
                              {"colour", colour},
                              {"upright", solid.upright},
                              {"outline", outline},
                              {"from", solid.from},
                              {"to", solid.to}});
  }
  write_file(file, plan.dump() + "\n");
}

}  // namespace triptych
