// OBJ, line by line: vertices, faces, objects and groups, and base colours from material libraries.
#include "base/error.hpp"
#include "scene/import_file.hpp"
#include "scene/import_reader.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace triptych {

namespace {

class ObjImport {
 public:
  explicit ObjImport(FileImport& target) : target_(target), reader_(target.file()) { parts_.emplace_back(); }

  void run() {
    std::string_view line;
    std::string joined;
    while (reader_.next_line(line)) {
      if (line.ends_with('\\')) {  // goes on in the next line
        joined.assign(line);
        while (joined.ends_with('\\') && reader_.next_line(line))
          joined.replace(joined.size() - 1, 1, " ").append(line);
        line = joined;
      }
      read_statement(line);
    }
    if (vertices_named_ > positions_.size()) {
      fail(target_.line_place(furthest_line_), "names vertex {} of {}", vertices_named_, positions_.size());
    }
    place_parts();
  }

 private:
  /// The faces between one `o` or `g` statement and the next.
  struct Part {
    std::string name;
    std::vector<Triangle> triangles;
  };

  void read_statement(std::string_view line) {
    if (const size_t comment = line.find('#'); comment != std::string_view::npos)
      line = line.substr(0, comment);
    const std::string_view word = take_word(line);
    if (word.empty() || word == "vt" || word == "vn" || word == "vp" || word == "s") return;
    if (word == "v") {
      read_vertex(line);
    } else if (word == "f" || word == "fo") {
      read_face(line);
    } else if (word == "o" || word == "g") {
      if (!parts_.back().triangles.empty()) parts_.emplace_back();
      parts_.back().name = std::string(trimmed(line));
    } else if (word == "usemtl") {
      use_material(std::string(trimmed(line)));
    } else if (word == "mtllib") {
      read_libraries(trimmed(line));
    } else if (word == "l" || word == "p") {
      target_.warn("lines or points were skipped");
    } else {
      target_.warn("statements are not understood and were skipped");
    }
  }

  void read_vertex(std::string_view line) {
    glm::dvec3 position;
    for (int i = 0; i < 3; ++i) {
      const auto number = to_number(take_word(line));
      if (!number) fail(reader_.line_place(), "a vertex wants three numbers");
      position[i] = *number;
    }
    int further = 0;
    while (!take_word(line).empty()) ++further;
    if (further >= 3) target_.warn("vertices with a colour, which is not drawn yet");
    if (positions_.size() == std::numeric_limits<uint32_t>::max())
      fail(reader_.line_place(), "more vertices than 32 bits can index");
    positions_.push_back(position);
  }

  void read_face(std::string_view line) {
    corners_.clear();
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      corners_.push_back(vertex_index(word));
    }
    if (corners_.size() < 3) return target_.warn("faces with fewer than three corners were skipped");
    for (size_t i = 2; i < corners_.size(); ++i) {
      parts_.back().triangles.push_back({{corners_[0], corners_[i - 1], corners_[i]}, material_});
    }
  }

  /// The vertex of "7", "7/1", "7//3", "-1/2/3"; counted from 0.
  uint32_t vertex_index(std::string_view word) {
    const auto number = to_integer(word.substr(0, word.find('/')));
    if (!number) fail(reader_.line_place(), "\"{}\" is no corner of a face", word.substr(0, 40));
    const auto known = static_cast<int64_t>(positions_.size());
    const int64_t index = *number < 0 ? known + *number : *number - 1;
    if (*number == 0 || index < 0 || index >= std::numeric_limits<uint32_t>::max()) {
      fail(reader_.line_place(), "names vertex {} of {}", *number, known);
    }
    const auto vertex = static_cast<uint32_t>(index);
    if (vertex >= vertices_named_) {  // it may follow later in the file; checked at its end
      vertices_named_ = uint64_t{vertex} + 1;
      furthest_line_ = reader_.line();
    }
    return vertex;
  }

  void use_material(const std::string& name) {
    const auto found = materials_.find(name);
    material_ = found == materials_.end() ? 0 : found->second;
    if (found == materials_.end())
      target_.warn("uses of a material that no library defines; drawn in the default colour");
  }

  void read_libraries(std::string_view names) {
    // One name with blanks in it, or several names.
    if (std::filesystem::is_regular_file(beside(names))) return read_library(beside(names));
    for (std::string_view name = take_word(names); !name.empty(); name = take_word(names)) {
      if (std::filesystem::is_regular_file(beside(name))) {
        read_library(beside(name));
      } else {
        target_.warn(fmt::format("material library is missing: {}", name));
      }
    }
  }

  std::filesystem::path beside(std::string_view name) const {
    std::string portable(name);
    std::replace(portable.begin(), portable.end(), '\\', '/');
    return target_.file().parent_path() / portable;
  }

  void read_library(const std::filesystem::path& file) {
    ImportReader library(file);
    Material material;
    std::string name;
    const auto finish = [&] {
      if (!name.empty()) materials_[name] = target_.add_material(material);
    };
    std::string_view line;
    while (library.next_line(line)) {
      const std::string_view word = take_word(line);
      if (word == "newmtl") {
        finish();
        material = {};
        name = std::string(trimmed(line));
      } else if (word == "Kd") {
        read_color(line, library, material);
      } else if (word == "d" || word == "Tr") {
        const auto number = to_number(take_word(line));  // "d -halo 0.5" has a word first
        if (number)
          material.base_color.a =
              std::clamp(static_cast<float>(word == "d" ? *number : 1 - *number), 0.0f, 1.0f);
      } else if (word == "map_Kd") {
        target_.warn("textures are not drawn yet");
      }
    }
    finish();
  }

  void read_color(std::string_view line, const ImportReader& library, Material& material) {
    std::array<double, 3> color;
    for (size_t i = 0; i < 3; ++i) {
      const std::string_view word = take_word(line);
      if (i > 0 && word.empty()) {  // one number stands for all three
        color[i] = color[0];
        continue;
      }
      const auto number = to_number(word);
      if (i == 0 && (word == "xyz" || word == "spectral"))
        return target_.warn("colours in a space other than RGB are not drawn");
      if (!number || !(std::abs(*number) <= largest_coordinate))
        fail(library.line_place(), "a colour wants three numbers");
      color[i] = std::clamp(*number, 0.0, 1.0);
    }
    for (int i = 0; i < 3; ++i) material.base_color[i] = static_cast<float>(color[static_cast<size_t>(i)]);
  }

  /// Each part becomes a mesh of the vertices that it uses.
  void place_parts() {
    std::vector<uint32_t> local(positions_.size()), owner(positions_.size(), 0);
    uint32_t number = 0;
    for (Part& part : parts_) {
      if (part.triangles.empty()) continue;
      ++number;
      Mesh mesh{.name = std::move(part.name), .positions = {}, .triangles = std::move(part.triangles)};
      for (Triangle& triangle : mesh.triangles) {
        for (uint32_t& vertex : triangle.vertices) {
          if (owner[vertex] != number) {
            owner[vertex] = number;
            local[vertex] = static_cast<uint32_t>(mesh.positions.size());
            mesh.positions.push_back(positions_[vertex]);
          }
          vertex = local[vertex];
        }
      }
      if (const auto added = target_.add_mesh(std::move(mesh))) target_.add_instance(*added, Affine(1));
    }
  }

  FileImport& target_;
  ImportReader reader_;
  std::vector<glm::dvec3> positions_;
  std::vector<Part> parts_;
  std::unordered_map<std::string, uint32_t> materials_;
  std::vector<uint32_t> corners_;
  uint32_t material_ = 0;
  uint64_t vertices_named_ = 0, furthest_line_ = 0;  ///< the highest number that a face names, and where
};

}  // namespace

void import_obj(FileImport& target) { ObjImport(target).run(); }

}  // namespace triptych
