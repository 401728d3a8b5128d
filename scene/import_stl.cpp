// STL, binary and ASCII. Vertices stay unshared as the file has them; welding comes with the build.
#include "base/error.hpp"
#include "scene/import_file.hpp"
#include "scene/import_reader.hpp"

#include <algorithm>
#include <cctype>

namespace triptych {

namespace {

constexpr uint64_t header_bytes = 84, facet_bytes = 50;

void add_triangle(Mesh& mesh, const std::array<glm::dvec3, 3>& corners) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({{first, first + 1, first + 2}, 0});
}

void place_mesh(FileImport& target, Mesh& mesh) {
  if (const auto added = target.add_mesh(std::move(mesh))) target.add_instance(*added, Affine(1));
  mesh = {};
}

void import_binary(FileImport& target, ImportReader& reader, uint32_t facets) {
  if (facets > std::numeric_limits<uint32_t>::max() / 3)
    fail(target.place(), "holds {} triangles, more than 32 bits can index", facets);
  Mesh mesh{.name = target.file().stem().string(), .positions = {}, .triangles = {}};
  mesh.positions.reserve(size_t{facets} * 3);
  mesh.triangles.reserve(facets);
  uint64_t attributes = 0;
  for (uint32_t i = 0; i < facets; ++i) {
    const auto bytes = reader.read(facet_bytes);
    std::array<float, 12> values;  // the normal, then three corners
    std::memcpy(values.data(), bytes.data(), sizeof(values));
    add_triangle(mesh,
                 {glm::dvec3(values[3], values[4], values[5]), glm::dvec3(values[6], values[7], values[8]),
                  glm::dvec3(values[9], values[10], values[11])});
    attributes += bytes[48] != std::byte{0} || bytes[49] != std::byte{0};
  }
  target.warn("facets with an attribute (a colour, in some dialects), which is not drawn", attributes);
  place_mesh(target, mesh);
}

bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

glm::dvec3 read_vertex(std::string_view rest, const ImportReader& reader) {
  glm::dvec3 position;
  for (int i = 0; i < 3; ++i) {
    const auto number = to_number(take_word(rest));
    if (!number) fail(reader.line_place(), "a vertex wants three numbers");
    position[i] = *number;
  }
  if (!take_word(rest).empty()) fail(reader.line_place(), "a vertex wants three numbers and nothing else");
  return position;
}

void import_ascii(FileImport& target, ImportReader& reader) {
  enum class Inside { nothing, solid, facet, loop } inside = Inside::nothing;
  Mesh mesh;
  std::array<glm::dvec3, 3> corners;
  size_t corner_count = 0;
  const auto step = [&](bool right_place, Inside next) {
    if (!right_place) fail(reader.line_place(), "a statement out of its place");
    inside = next;
  };
  std::string_view line;
  while (reader.next_line(line)) {
    const std::string_view word = take_word(line);
    if (word.empty()) continue;
    if (is_keyword(word, "vertex")) {
      step(inside == Inside::loop && corner_count < 3, Inside::loop);
      corners[corner_count++] = read_vertex(line, reader);
    } else if (is_keyword(word, "facet")) {
      step(inside == Inside::solid, Inside::facet);
    } else if (is_keyword(word, "outer")) {
      step(inside == Inside::facet, Inside::loop);
      corner_count = 0;
    } else if (is_keyword(word, "endloop")) {
      step(inside == Inside::loop && corner_count == 3, Inside::facet);
      if (mesh.positions.size() > std::numeric_limits<uint32_t>::max() - 3)
        fail(reader.line_place(), "more vertices than 32 bits can index");
      add_triangle(mesh, corners);
    } else if (is_keyword(word, "endfacet")) {
      step(inside == Inside::facet, Inside::solid);
    } else if (is_keyword(word, "solid")) {
      step(inside == Inside::nothing, Inside::solid);
      mesh.name = std::string(trimmed(line));
    } else if (is_keyword(word, "endsolid")) {
      step(inside == Inside::solid, Inside::nothing);
      place_mesh(target, mesh);
    } else {
      fail(reader.line_place(), "is no statement of an ASCII STL file");
    }
  }
  if (inside != Inside::nothing) fail(reader.line_place(), "the file ends within a solid");
}

}  // namespace

void import_stl(FileImport& target) {
  // The size tells binary from ASCII: many binary files begin with "solid" too.
  ImportReader reader(target.file());
  if (reader.size() >= header_bytes) {
    const auto header = reader.read(header_bytes);
    uint32_t facets = 0;
    std::memcpy(&facets, header.data() + 80, sizeof(facets));
    if (reader.size() == header_bytes + facet_bytes * facets) return import_binary(target, reader, facets);
  }
  ImportReader text(target.file());
  std::string_view line;
  bool solid = false;
  while (!solid && text.next_line(line)) {
    const std::string_view word = take_word(line);
    if (word.empty()) continue;
    if (!is_keyword(word, "solid")) break;
    solid = true;
  }
  if (text.size() == 0) fail(target.place(), "is empty");
  if (!solid)
    fail(target.place(),
         "is no STL file: neither ASCII nor of the length that a binary one of its count has");
  ImportReader again(target.file());
  import_ascii(target, again);
}

}  // namespace triptych
