// STL, binary and ASCII. Vertices stay unshared as in the file; the build welds them.
#include "base/error.hpp"
#include "model/import/import_file.hpp"
#include "model/import/import_reader.hpp"
#include "model/import/mesh_spool.hpp"
#include "model/import/mesh_stream_stl.hpp"

#include <algorithm>
#include <cctype>

namespace triptych {

namespace {

constexpr uint64_t header_bytes = StlStream::header_bytes, facet_bytes = StlStream::facet_bytes;

void add_triangle(Mesh& mesh, const std::array<glm::dvec3, 3>& corners) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({{first, first + 1, first + 2}, 0});
}

void import_binary(FileImport& target, uint64_t facets) {
  const std::string name = target.file().stem().string();
  const auto stream = std::make_shared<StlStream>(std::make_shared<StreamSource>(target.file()), facets);
  if (target.should_stream(facets)) return target.add_instance(target.add_stream(name, stream), Affine(1));
  Mesh mesh{.name = name, .positions = {}, .triangles = {}};
  target.count_dropped(stream->read([&](std::span<const CornerTriangle> batch) {
    for (const CornerTriangle& triangle : batch) add_triangle(mesh, triangle.corners);
  }));
  target.take_warnings(*stream);
  if (const auto added = target.add_mesh(std::move(mesh))) target.add_instance(*added, Affine(1));
}

bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

glm::dvec3 read_vertex(std::string_view rest, const ImportReader& reader) {
  glm::dvec3 position;
  for (int i = 0; i < 3; ++i) {
    const auto number = to_number(take_word(rest));
    if (!number) fail(reader.line_place(), "a vertex needs three numbers");
    position[i] = *number;
  }
  if (!take_word(rest).empty()) fail(reader.line_place(), "a vertex needs three numbers and nothing else");
  return position;
}

void import_ascii(FileImport& target, ImportReader& reader) {
  enum class Inside { nothing, solid, facet, loop } inside = Inside::nothing;
  MeshSpool spool(target);
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
      spool.add_vertex(read_vertex(line, reader));
      ++corner_count;
    } else if (is_keyword(word, "facet")) {
      step(inside == Inside::solid, Inside::facet);
    } else if (is_keyword(word, "outer")) {
      step(inside == Inside::facet, Inside::loop);
      corner_count = 0;
    } else if (is_keyword(word, "endloop")) {
      step(inside == Inside::loop && corner_count == 3, Inside::facet);
      const auto last = static_cast<uint32_t>(spool.vertex_count() - 1);
      spool.add_face(std::array<uint32_t, 3>{last - 2, last - 1, last}, 0);
    } else if (is_keyword(word, "endfacet")) {
      step(inside == Inside::facet, Inside::solid);
    } else if (is_keyword(word, "solid")) {
      step(inside == Inside::nothing, Inside::solid);
      spool.begin_mesh(std::string(trimmed(line)));
    } else if (is_keyword(word, "endsolid")) {
      step(inside == Inside::solid, Inside::nothing);
    } else {
      fail(reader.line_place(), "is not a statement of an ASCII STL file");
    }
  }
  if (inside != Inside::nothing) fail(reader.line_place(), "the file ends within a solid");
  spool.finish();
}

}  // namespace

void import_stl(FileImport& target) {
  // The size distinguishes binary from ASCII: many binary files begin with "solid" too.
  ImportReader reader(target.file());
  if (reader.size() >= header_bytes) {
    const auto header = reader.read(header_bytes);
    uint32_t facets = 0;
    std::memcpy(&facets, header.data() + 80, sizeof(facets));
    if (reader.size() == header_bytes + facet_bytes * facets) return import_binary(target, facets);
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
         "is not an STL file: it is neither ASCII nor as long as its count of facets requires");
  ImportReader again(target.file());
  import_ascii(target, again);
}

}  // namespace triptych
