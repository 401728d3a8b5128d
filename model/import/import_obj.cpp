// OBJ, line by line: vertices, faces, objects and groups, and base colours from material libraries.
#include "base/error.hpp"
#include "model/import/import_file.hpp"
#include "model/import/import_reader.hpp"
#include "model/import/mesh_spool.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace triptych {

namespace {

std::filesystem::path beside(const std::filesystem::path& file, std::string_view name) {
  std::string portable(name);
  std::replace(portable.begin(), portable.end(), '\\', '/');
  return file.parent_path() / portable;
}

/// The files that a statement names: one with blanks in its name, or several.
std::vector<std::string_view> names_in(std::string_view names, const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_regular_file(beside(file, names), error)) return {names};
  std::vector<std::string_view> words;
  for (std::string_view name = take_word(names); !name.empty(); name = take_word(names))
    words.push_back(name);
  return words;
}

class ObjImport {
 public:
  explicit ObjImport(FileImport& target) : target_(target), reader_(target.file()), spool_(target) {}

  void run() {
    std::string_view line;
    std::string joined;
    while (reader_.next_line(line)) {
      if (line.ends_with('\\')) {  // continues in the next line
        joined.assign(line);
        while (joined.ends_with('\\') && reader_.next_line(line))
          joined.replace(joined.size() - 1, 1, " ").append(line);
        line = joined;
      }
      read_statement(line);
    }
    if (vertices_named_ > spool_.vertex_count()) {
      fail(target_.line_place(furthest_line_), "names vertex {} of {}", vertices_named_,
           spool_.vertex_count());
    }
    spool_.finish();
  }

 private:
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
      spool_.begin_mesh(std::string(trimmed(line)));
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
      if (!number) fail(reader_.line_place(), "a vertex needs three numbers");
      position[i] = *number;
    }
    int further = 0;
    while (!take_word(line).empty()) ++further;
    if (further >= 3) target_.warn("vertices with a colour, which is not drawn yet");
    spool_.add_vertex(position);
  }

  void read_face(std::string_view line) {
    corners_.clear();
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      corners_.push_back(vertex_index(word));
    }
    spool_.add_face(corners_, material_);
  }

  /// The vertex of "7", "7/1", "7//3", "-1/2/3"; counted from 0.
  uint32_t vertex_index(std::string_view word) {
    const auto number = to_integer(word.substr(0, word.find('/')));
    if (!number) fail(reader_.line_place(), "\"{}\" is not a corner of a face", word.substr(0, 40));
    const auto known = static_cast<int64_t>(spool_.vertex_count());
    const int64_t index = *number < 0 ? known + *number : *number - 1;
    if (*number == 0 || index < 0 || index >= std::numeric_limits<uint32_t>::max()) {
      fail(reader_.line_place(), "names vertex {} of {}", *number, known);
    }
    const auto vertex = static_cast<uint32_t>(index);
    if (vertex >= vertices_named_) {  // it may be defined later in the file; checked at the end
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
    for (const std::string_view name : names_in(names, target_.file())) {
      const std::filesystem::path library = beside(target_.file(), name);
      std::error_code error;
      if (std::filesystem::is_regular_file(library, error)) {
        read_library(library);
      } else {
        target_.warn(fmt::format("material library is missing: {}", name));
      }
    }
  }

  void read_library(const std::filesystem::path& file) {
    ImportReader library(file);
    target_.also_reads(file);
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
        if (material.base_color.a < 1) target_.warn("transparent materials are drawn opaque");
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
      if (!number || !(std::abs(*number) <= max_import_coordinate))
        fail(library.line_place(), "a colour needs three numbers");
      color[i] = std::clamp(*number, 0.0, 1.0);
    }
    for (int i = 0; i < 3; ++i) material.base_color[i] = static_cast<float>(color[static_cast<size_t>(i)]);
  }

  FileImport& target_;
  ImportReader reader_;
  MeshSpool spool_;
  std::unordered_map<std::string, uint32_t> materials_;
  std::vector<uint32_t> corners_;
  uint32_t material_ = 0;
  uint64_t vertices_named_ = 0, furthest_line_ = 0;  ///< the highest vertex number of a face, and its line
};

}  // namespace

void import_obj(FileImport& target) { ObjImport(target).run(); }

namespace {
/// Adds the files named by statements whose first word is `wanted`.
void add_named(const std::filesystem::path& file, bool (*wanted)(std::string_view),
               std::vector<std::filesystem::path>& files) {
  ImportReader reader(file);
  for (std::string_view line; reader.next_line(line);) {
    if (!wanted(take_word(line))) continue;
    for (const std::string_view name : names_in(trimmed(line), file)) files.push_back(beside(file, name));
  }
}
}  // namespace

std::vector<std::filesystem::path> files_beside_obj(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> files;
  add_named(
      file, [](std::string_view word) { return word == "mtllib"; }, files);
  for (size_t i = 0, libraries = files.size(); i < libraries; ++i) {
    const std::filesystem::path library = files[i];
    std::error_code error;
    if (!std::filesystem::is_regular_file(library, error)) continue;
    constexpr auto texture = [](std::string_view word) {
      return word.starts_with("map_") || word == "bump" || word == "disp" || word == "decal" ||
             word == "refl" || word == "norm";
    };
    add_named(library, texture, files);
  }
  return files;
}

}  // namespace triptych
