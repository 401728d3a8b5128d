// The materials of OBJ: MTL files, with the images that they name.
#pragma once

#include "model/import/import_file.hpp"

#include <functional>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace triptych {

/// The text before a comment. In numbers any # begins one; names hold it too ("Material#25"), so there it
/// must stand behind a blank.
std::string_view without_obj_comment(std::string_view line, bool names);

/// What a statement as map_Kd says: options, and a file.
struct ObjTextureUse {
  std::string name;                ///< of the file, as it stands there; empty where none is named
  glm::dvec2 scale{1}, offset{0};  ///< a place (u, v) of the file is at scale · (u, v) + offset
  bool clamps = false;             ///< beyond its edges the texture does not repeat
  std::string not_applied;         ///< the first of the options that change the picture and are not drawn
  bool has_place_of(const ObjTextureUse& other) const {
    return scale == other.scale && offset == other.offset && clamps == other.clamps;
  }
};

/// statement: behind its first word. Names may hold blanks.
ObjTextureUse read_obj_texture(std::string_view statement);

/// A material, and how its textures lie on faces.
struct ObjSurface {
  Material material;
  glm::dvec2 scale{1}, offset{0};
  bool is_textured() const { return material.texture != no_id || material.emission_texture != no_id; }
  /// Of places as the file has them, from the lower left corner.
  TextureCoordinates place(const glm::dvec2& uv) const {
    return texture_coordinates(scale.x * uv.x + offset.x, 1 - (scale.y * uv.y + offset.y));
  }
};

/// Reads the libraries of one model; images that several materials name are one.
class ObjLibraries {
 public:
  explicit ObjLibraries(FileImport& target) : target_(target) {}

  /// Calls with each material, in the file's order. Images that are missing, and what is not understood, are
  /// warned of.
  using Define = std::function<void(const std::string& name, const ObjSurface& surface)>;
  void read(const std::shared_ptr<const StreamSource>& file, const Define& define);

 private:
  struct Read;
  std::optional<glm::vec4> read_color(std::string_view line);
  void take_textures(Read& read, const std::string& place);
  uint32_t image(const std::string& color, const std::string& alpha, const std::string& place);
  std::optional<ModelImage> open(const std::string& name, const std::string& place);

  FileImport& target_;
  std::map<std::pair<std::string, std::string>, uint32_t> images_;  ///< by colours and alpha
  std::string first_missing_, first_option_;                        ///< warnings
};

}  // namespace triptych
