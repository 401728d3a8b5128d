// STL, binary and ASCII. Vertices stay unshared as in the file; the build welds them.
#include "base/error.hpp"
#include "model/import/beside.hpp"
#include "model/import/import_file.hpp"
#include "model/import/import_reader.hpp"
#include "model/import/import_stl_colors.hpp"
#include "model/import/mesh_spool.hpp"
#include "model/import/mesh_stream_stl.hpp"

#include <algorithm>

namespace triptych {

namespace {

constexpr uint64_t header_bytes = StlStream::header_bytes, facet_bytes = StlStream::facet_bytes;

void add_triangle(Mesh& mesh, const CornerTriangle& triangle) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), triangle.corners.begin(), triangle.corners.end());
  mesh.triangles.push_back({{first, first + 1, first + 2}, triangle.material});
}

void import_binary(FileImport& target, uint64_t facets, std::span<const std::byte> header) {
  const std::string name = target.file().stem().string();
  const auto source = target.content();
  const auto stream =
      std::make_shared<StlStream>(source, facets, stl_materials(source, facets, header, target));
  if (target.should_stream(facets)) return target.add_instance(target.add_stream(name, stream), Affine(1));
  Mesh mesh{.name = name, .positions = {}, .triangles = {}};
  target.count_dropped(stream->read([&](std::span<const CornerTriangle> batch) {
    for (const CornerTriangle& triangle : batch) add_triangle(mesh, triangle);
  }));
  target.take_warnings(*stream);
  if (const auto added = target.add_mesh(std::move(mesh))) target.add_instance(*added, Affine(1));
}

bool is_keyword(std::string_view word, std::string_view keyword) { return equal_but_for_case(word, keyword); }

/// Reads ASCII STL word by word, as its dialects need: "end loop" and "endloop", several statements in a
/// line, a solid that nothing ends, more than three corners in a loop.
class AsciiStl {
 public:
  explicit AsciiStl(FileImport& target) : target_(target), reader_(target.content()), spool_(target) {}

  void run() {
    for (std::string_view word = next_word(); !word.empty(); word = next_word()) {
      if (is_keyword(word, "vertex")) {
        read_vertex();
      } else if (is_keyword(word, "solid")) {
        end_facet();
        spool_.begin_object(std::string(trimmed(line_)));
        line_ = {};
      } else if (is_keyword(word, "endsolid")) {
        end_facet();
        line_ = {};
      } else if (is_keyword(word, "facet")) {
        end_facet();
        line_ = behind_normal();
      } else if (is_keyword(word, "endloop") || is_keyword(word, "endfacet")) {
        end_facet();
      } else if (is_keyword(word, "end")) {
        end_facet();
        if (is_keyword(next_word(), "solid")) line_ = {};
      } else if (!is_keyword(word, "outer") && !is_keyword(word, "loop")) {
        target_.warn("lines are not understood and were skipped");
        line_ = {};
      }
    }
    end_facet();
    spool_.finish();
  }

 private:
  std::string_view next_word() {
    std::string_view word = take_word(line_);
    while (word.empty() && reader_.next_line(line_)) word = take_word(line_);
    return word;
  }

  /// What follows a facet's normal in its line: the normal is not used, and may be anything.
  std::string_view behind_normal() const {
    std::string_view rest = line_;
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
      if (is_keyword(word, "outer")) return rest;
    }
    return {};
  }

  /// The next number, also from the next line if this one has ended; nothing where something else stands,
  /// which is left there if it begins a line.
  std::optional<double> next_number() {
    if (trimmed(line_).empty()) {
      while (trimmed(line_).empty()) {
        if (!reader_.next_line(line_)) return std::nullopt;
      }
      std::string_view rest = line_;
      if (!to_number(take_word(rest))) return std::nullopt;
    }
    return to_number(take_word(line_));
  }

  void read_vertex() {
    glm::dvec3 position;
    for (int i = 0; i < 3; ++i) {
      const auto number = next_number();
      damaged_ = damaged_ || !number;
      if (!number) return;
      position[i] = *number;
    }
    corners_.push_back(position);
  }

  void end_facet() {
    if (damaged_ || (!corners_.empty() && corners_.size() < 3)) {
      target_.warn(first_damaged_.empty() ? first_damaged_ =
                                                "facets without three corners of three numbers each "
                                                "were skipped, the first before line " +
                                                std::to_string(reader_.line())
                                          : first_damaged_);
    } else if (!corners_.empty()) {
      face_.clear();
      for (const glm::dvec3& corner : corners_) {
        face_.push_back(static_cast<uint32_t>(spool_.vertex_count()));
        spool_.add_vertex(corner);
      }
      spool_.add_face(face_, 0);
    }
    corners_.clear();
    damaged_ = false;
  }

  FileImport& target_;
  ImportReader reader_;
  MeshSpool spool_;
  std::string_view line_;
  std::vector<glm::dvec3> corners_;  ///< of the facet that is being read
  std::vector<uint32_t> face_;
  bool damaged_ = false;
  std::string first_damaged_;
};

/// Whether the beginning of the file is text: binary STL holds zeros and other control characters soon.
bool is_text(const StreamSource& source, const SourceReader& reader) {
  std::vector<std::byte> beginning(std::min<uint64_t>(source.size(), 2048));
  reader.read(0, beginning);
  return std::none_of(beginning.begin(), beginning.end(), [](std::byte letter) {
    const auto value = std::to_integer<int>(letter);
    return value < 0x20 && value != '\t' && value != '\n' && value != '\r' && value != '\f' && value != '\v';
  });
}

bool begins_with_solid(const std::shared_ptr<const StreamSource>& source) {
  ImportReader text(source);
  std::string_view line;
  while (text.next_line(line)) {
    if (const std::string_view word = take_word(line); !word.empty()) return is_keyword(word, "solid");
  }
  return false;
}

}  // namespace

void import_stl(FileImport& target) {
  const auto source = target.content();
  if (source->size() == 0) fail(target.place(), "is empty");
  const SourceReader reader(source);
  std::vector<std::byte> header(std::min(source->size(), header_bytes));
  reader.read(0, header);
  uint64_t promised = 0, held = 0;
  if (header.size() == header_bytes) {
    uint32_t facets = 0;
    std::memcpy(&facets, header.data() + 80, sizeof(facets));
    promised = facets;
    held = (source->size() - header_bytes) / facet_bytes;
    if (source->size() == header_bytes + facet_bytes * promised)
      return import_binary(target, promised, header);
  }
  // Many binary files begin with "solid" too.
  const bool text = is_text(*source, reader);
  if (text && begins_with_solid(source)) return AsciiStl(target).run();
  const uint64_t left_over = source->size() - std::min(source->size(), header_bytes + held * facet_bytes);
  const bool unknown_count = (promised == 0 || promised == 0xffffffff) && left_over == 0;
  const bool plausible = unknown_count || promised / 1000 <= held;  // a cut file; noise promises anything
  if (text || held == 0 || !plausible)
    fail(target.place(), "is not an STL file: neither text that begins with \"solid\" nor binary facets");
  const uint64_t facets = std::min(unknown_count ? held : promised, held);
  const uint64_t left = source->size() - header_bytes - facets * facet_bytes;
  target.warn("bytes after the last facet were skipped", left);
  if (promised != facets)
    target.remark(fmt::format("the header promises {} facets, the file holds {}", promised, facets));
  import_binary(target, facets, header);
}

}  // namespace triptych
