// OBJ, line by line: vertices, faces, objects and groups, and base colours from material libraries.
#include "base/error.hpp"
#include "base/one_line.hpp"
#include "model/import/beside.hpp"
#include "model/import/import_file.hpp"
#include "model/import/import_reader.hpp"
#include "model/import/mesh_spool.hpp"
#include "model/import/obj_library.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace triptych {

namespace {

/// Whether the line goes on in the next one: a backslash at the end of a comment says nothing.
bool continues(std::string_view line) {
  return line.ends_with('\\') && line.find('#') == std::string_view::npos;
}

/// The files that a statement names, one with blanks in its name or several: `is_there` decides.
template <typename IsThere>
std::vector<std::string_view> names_in(std::string_view names, const IsThere& is_there) {
  names = trimmed(names);
  if (is_there(names)) return {names};
  std::vector<std::string_view> words;
  for (std::string_view name = take_word(names); !name.empty(); name = take_word(names))
    words.push_back(name);
  return words;
}

class ObjImport {
 public:
  explicit ObjImport(FileImport& target)
      : target_(target), reader_(target.content()), spool_(target), libraries_(target) {}

  void run() {
    std::string_view line;
    std::string joined;
    while (reader_.next_line(line)) {
      if (continues(line)) {
        joined.assign(line);
        while (continues(joined) && reader_.next_line(line))
          joined.replace(joined.size() - 1, 1, " ").append(line);
        line = joined;
      }
      read_statement(line);
    }
    add_missing_vertices();
    // Colours of 0 to 255: a little above 1 is what light or rounding adds.
    if (highest_channel_ > 2) spool_.scale_colors(1 / 255.0);
    spool_.finish();
    for (const auto& [name, material] : materials_) {
      if (!material.defined)
        target_.warn("uses of a material that no library defines; drawn in the default colour",
                     material.uses);
    }
  }

 private:
  struct NamedMaterial {
    uint32_t number = 0;   ///< in the model
    bool defined = false;  ///< by a library, which may be named after its uses
    uint64_t uses = 0;
    std::shared_ptr<const ObjSurface> surface = nullptr;  ///< of one with a texture
  };

  void read_statement(std::string_view whole) {
    std::string_view line = without_obj_comment(whole, true);
    const std::string_view word = take_word(line);
    const auto behind_word = static_cast<size_t>(word.data() + word.size() - whole.data());
    const auto name = [&] { return trimmed(without_obj_comment(whole, true).substr(behind_word)); };
    if (word.empty() || word == "vp" || word == "s") return;
    if (word == "v") {
      read_vertex(line);
    } else if (word == "vt") {
      read_place(line);
    } else if (word == "vn") {
      read_normal(line);
    } else if (word == "f" || word == "fo") {
      read_face(without_obj_comment(line, false));
    } else if (word == "o") {
      spool_.begin_object(std::string(name()));
    } else if (word == "g") {
      spool_.begin_group(std::string(name()));
    } else if (word == "usemtl") {
      use_material(std::string(name()));
    } else if (word == "mtllib") {
      read_libraries(name());
    } else if (word == "l" || word == "p") {
      target_.warn("lines or points were skipped");
    } else {
      skip_statement(word);
    }
  }

  /// One warning for all of a kind, with the first one's line.
  void warn_once(std::string& first, std::string what) {
    if (first.empty()) first = std::move(what);
    target_.warn(first);
  }

  /// Vertices that faces name and the file does not hold (it was cut, or faces are damaged) are not finite,
  /// so that only the triangles that use them are lost. Error where they are too many for that.
  void add_missing_vertices() {
    constexpr uint64_t most = uint64_t{1} << 16;
    const uint64_t known = spool_.vertex_count();
    if (vertices_named_ <= known) return;
    if (vertices_named_ - known > most)
      fail(target_.line_place(furthest_line_), "names vertex {} of {}", vertices_named_, known);
    target_.remark(
        fmt::format("line {} names vertex {} of {}; triangles with vertices that are not there are dropped",
                    furthest_line_, vertices_named_, known));
    while (spool_.vertex_count() < vertices_named_)
      spool_.add_vertex(glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
  }

  /// One without three numbers is kept as not finite: the numbers of all others stay what they are.
  void read_vertex(std::string_view line) {
    glm::dvec3 position;
    for (int i = 0; i < 3; ++i) {
      const auto number = to_number(take_word(line));
      if (!number) {
        warn_once(first_bad_vertex_,
                  fmt::format("vertices lack three numbers, the first in line {}; their triangles "
                              "are dropped",
                              reader_.line()));
        return spool_.add_vertex(glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
      }
      position[i] = *number;
    }
    const auto color = read_vertex_color(line);
    if (color) highest_channel_ = std::max({highest_channel_, color->x, color->y, color->z});
    spool_.add_vertex(position, color);
  }

  /// What follows the position: red, green and blue, or a weight before them, which is not used.
  std::optional<glm::dvec3> read_vertex_color(std::string_view line) {
    std::array<double, 4> numbers;
    size_t count = 0;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      const auto number = to_number(word);
      if (!number || !std::isfinite(*number)) return std::nullopt;
      if (count < numbers.size()) numbers[count++] = *number;
    }
    if (count < 3) return std::nullopt;
    return glm::dvec3(numbers[count - 3], numbers[count - 2], numbers[count - 1]);
  }

  /// One without three numbers counts, and is none. Files have them before the first face that may use them.
  void read_normal(std::string_view line) {
    constexpr size_t most = size_t{1} << 26;
    if (normals_.empty() && spool_.has_faces())
      return target_.warn("normals behind the first faces are not used");
    if (normals_.size() == most) return target_.warn("normals beyond the first 67,108,864 are not used");
    if (normals_.empty()) spool_.shade_faces();
    glm::dvec3 normal;
    for (int i = 0; i < 3; ++i)
      normal[i] = to_number(take_word(line)).value_or(std::numeric_limits<double>::quiet_NaN());
    normals_.push_back(to_vertex_normal(normal));
  }

  /// One without two numbers is at 0 there. Where libraries were read and name no texture, none is kept.
  void read_place(std::string_view line) {
    constexpr size_t most = size_t{1} << 26;
    if (has_libraries_ && !has_textures_) {
      skips_places_ = true;
      return;
    }
    if (places_.size() == most)
      return target_.warn("texture coordinates beyond the first 67,108,864 are not used");
    glm::dvec2 place(0);
    for (int i = 0; i < 2; ++i) place[i] = to_number(take_word(line)).value_or(0);
    places_.push_back(place);
  }

  /// Of "7/1" and "7/1/3"; none where the corner names none, or one that is not there.
  TextureCoordinates place_of(std::string_view word) const {
    const size_t first = word.find('/');
    if (first == std::string_view::npos) return {};
    const std::string_view own = word.substr(first + 1);
    const auto number = to_integer(own.substr(0, own.find('/')));
    if (!number) return {};
    const auto known = static_cast<int64_t>(places_.size());
    const int64_t index = *number < 0 ? known + *number : *number - 1;
    return index >= 0 && index < known ? surface_->place(places_[static_cast<size_t>(index)])
                                       : TextureCoordinates{};
  }

  /// Of "7//3" and "7/1/3"; none where the corner names none, or one that is not there.
  VertexNormal normal_of(std::string_view word) const {
    const size_t first = word.find('/');
    const size_t second = first == std::string_view::npos ? first : word.find('/', first + 1);
    if (second == std::string_view::npos) return {};
    const auto number = to_integer(word.substr(second + 1));
    if (!number) return {};
    const auto known = static_cast<int64_t>(normals_.size());
    const int64_t index = *number < 0 ? known + *number : *number - 1;
    return index >= 0 && index < known ? normals_[static_cast<size_t>(index)] : VertexNormal{};
  }

  void read_face(std::string_view line) {
    corners_.clear();
    corner_normals_.clear();
    corner_places_.clear();
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      const auto vertex = vertex_index(word);
      if (!vertex) return;
      corners_.push_back(*vertex);
      if (!normals_.empty()) corner_normals_.push_back(normal_of(word));
      if (surface_) corner_places_.push_back(place_of(word));
    }
    spool_.add_face(corners_, material_, {}, corner_normals_, corner_places_);
  }

  /// The vertex of "7", "7/1", "7//3", "-1/2/3"; counted from 0. Nothing, and a warning, if it is none.
  std::optional<uint32_t> vertex_index(std::string_view word) {
    const auto number = to_integer(word.substr(0, word.find('/')));
    if (!number)
      return bad_face(fmt::format("has \"{}\" for a corner", one_line(std::string(word.substr(0, 40)))));
    const auto known = static_cast<int64_t>(spool_.vertex_count());
    const int64_t index = *number < 0 ? known + *number : *number - 1;
    if (*number == 0 || index < 0 || index >= std::numeric_limits<uint32_t>::max()) {
      return bad_face(fmt::format("names vertex {} of {}", *number, known));
    }
    const auto vertex = static_cast<uint32_t>(index);
    if (vertex >= vertices_named_) {  // it may be defined later in the file; checked at the end
      vertices_named_ = uint64_t{vertex} + 1;
      furthest_line_ = reader_.line();
    }
    return vertex;
  }

  std::nullopt_t bad_face(const std::string& why) {
    warn_once(first_bad_face_, fmt::format("faces cannot be read and were skipped; the first, in line {}, {}",
                                           reader_.line(), why));
    return std::nullopt;
  }

  void skip_statement(std::string_view word) {
    constexpr size_t most = 8;  // kinds that are named
    const std::string kind(word.substr(0, 20));
    if (skipped_.size() < most) skipped_.insert(kind);
    target_.warn(skipped_.count(kind) > 0
                     ? fmt::format("statements \"{}\" are not understood and were skipped", one_line(kind))
                     : "statements of further kinds are not understood and were skipped");
  }

  NamedMaterial& material_named(const std::string& name) {
    const auto [found, added] = materials_.try_emplace(name);
    if (added) found->second.number = target_.add_material(Material());
    return found->second;
  }

  void use_material(const std::string& name) {
    NamedMaterial& material = material_named(name);
    ++material.uses;
    material_ = material.number;
    surface_ = material.surface;
  }

  void read_libraries(std::string_view names) {
    for (const std::string_view name :
         names_in(names, [&](std::string_view file) { return target_.beside(file) != nullptr; })) {
      if (const auto library = target_.beside(name)) {
        has_libraries_ = true;
        libraries_.read(library, [&](const std::string& material, const ObjSurface& surface) {
          define(material, surface);
        });
      } else {
        target_.warn(
            fmt::format("material library is missing: {}", one_line(std::string(name.substr(0, 80)))));
      }
    }
  }

  /// What follows in the file uses the library's material; so does what came before, if it had none.
  void define(const std::string& name, const ObjSurface& surface) {
    NamedMaterial& named = material_named(name);
    if (named.defined) named = {.number = target_.add_material(Material())};
    named.defined = true;
    Material material = surface.material;
    if (surface.is_textured() &&
        (named.uses > 0 || skips_places_ || (!has_textures_ && spool_.has_faces()))) {
      target_.warn("textures of materials that a library defines behind the first faces are not drawn");
      material.texture = material.emission_texture = no_id;
      material.cutoff = 0;
    } else if (surface.is_textured()) {
      named.surface = std::make_shared<const ObjSurface>(surface);
      if (!has_textures_) spool_.place_faces();
      has_textures_ = true;
    }
    target_.set_material(named.number, material);
  }

  FileImport& target_;
  ImportReader reader_;
  MeshSpool spool_;
  ObjLibraries libraries_;
  std::map<std::string, NamedMaterial> materials_;
  std::set<std::string> skipped_;  ///< kinds of statements that are not understood
  std::vector<uint32_t> corners_;
  std::vector<VertexNormal> normals_, corner_normals_;  ///< of the file; of the face that is read
  std::vector<glm::dvec2> places_;                      ///< vt of the file
  std::vector<TextureCoordinates> corner_places_;
  bool has_libraries_ = false, has_textures_ = false, skips_places_ = false;
  uint32_t material_ = 0;
  std::shared_ptr<const ObjSurface> surface_;        ///< of the material, if that has a texture
  std::string first_bad_vertex_, first_bad_face_;    ///< warnings
  double highest_channel_ = 0;                       ///< of all colours of vertices
  uint64_t vertices_named_ = 0, furthest_line_ = 0;  ///< the highest vertex number of a face, and its line
};

}  // namespace

void import_obj(FileImport& target) { ObjImport(target).run(); }

namespace {
/// Adds the files named by statements whose first word is `wanted`, whether or not they exist.
void add_named(const std::filesystem::path& file, bool (*wanted)(std::string_view),
               std::vector<std::filesystem::path>& files) {
  ImportReader reader(file);
  const auto folder = file.parent_path();
  for (std::string_view line; reader.next_line(line);) {
    if (!wanted(take_word(line))) continue;
    for (const std::string_view name :
         names_in(line, [&](std::string_view whole) { return find_beside(folder, whole).has_value(); }))
      files.push_back(find_beside(folder, name).value_or(folder / name));
  }
}

void add_textures(const std::filesystem::path& library, std::vector<std::filesystem::path>& files) {
  ImportReader reader(library);
  const auto folder = library.parent_path();
  for (std::string_view line; reader.next_line(line);) {
    const std::string_view word = take_word(line);
    if (!word.starts_with("map_") && word != "bump" && word != "disp" && word != "decal" && word != "refl" &&
        word != "norm")
      continue;
    const std::string name = read_obj_texture(line).name;
    if (!name.empty()) files.push_back(find_beside(folder, name).value_or(folder / name));
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
    add_textures(library, files);
  }
  return files;
}

}  // namespace triptych
