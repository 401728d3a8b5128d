#include "model/import/obj_library.hpp"

#include "base/one_line.hpp"
#include "model/import/display_color.hpp"
#include "model/import/import_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace triptych {

namespace {

constexpr size_t shown_letters = 80;
/// Where alpha is less there is a hole: files that say it mean what is cut out, as leaves and fences.
constexpr float dissolve_cutoff = 0.5f;

std::string shown(std::string_view text) { return one_line(std::string(text.substr(0, shown_letters))); }

/// Options and how many words they take; -o, -s and -t take up to three numbers.
struct TextureOption {
  std::string_view word;
  size_t values;
  bool shows;  ///< whether it changes the picture, and is not drawn
};
constexpr std::array texture_options = {
    TextureOption{"-blendu", 1, false}, TextureOption{"-blendv", 1, false}, TextureOption{"-boost", 1, false},
    TextureOption{"-texres", 1, false}, TextureOption{"-bm", 1, false},     TextureOption{"-cc", 1, true},
    TextureOption{"-mm", 2, true},      TextureOption{"-imfchan", 1, true}, TextureOption{"-type", 1, true},
    TextureOption{"-clamp", 1, false}};

/// Up to three numbers off the front.
std::array<std::optional<double>, 3> take_numbers(std::string_view& text) {
  std::array<std::optional<double>, 3> numbers;
  for (auto& number : numbers) {
    std::string_view rest = text;
    const std::string_view word = take_word(rest);
    number = to_number(word);
    if (!number || !std::isfinite(*number)) {
      number.reset();
      break;
    }
    text = rest;
  }
  return numbers;
}

}  // namespace

std::string_view without_obj_comment(std::string_view line, bool names) {
  for (size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1)) {
    if (!names || at == 0 || line[at - 1] == ' ' || line[at - 1] == '\t') return line.substr(0, at);
  }
  return line;
}

ObjTextureUse read_obj_texture(std::string_view statement) {
  ObjTextureUse use;
  const auto not_applied = [&](std::string_view option) {
    if (use.not_applied.empty()) use.not_applied = std::string(option);
  };
  std::string_view left = trimmed(without_obj_comment(statement, true));
  while (left.starts_with('-')) {
    std::string_view rest = left;
    const std::string_view word = take_word(rest);
    if (word == "-o" || word == "-s" || word == "-t") {
      const auto [u, v, w] = take_numbers(rest);
      if (word == "-o") use.offset = {u.value_or(0), v.value_or(0)};
      if (word == "-s") use.scale = {u.value_or(1), v.value_or(1)};
      if (word == "-t" && (u.value_or(0) != 0 || v.value_or(0) != 0)) not_applied(word);
    } else {
      const auto* const option = std::ranges::find(texture_options, word, &TextureOption::word);
      if (option == texture_options.end()) break;  // a name that begins with a dash
      for (size_t i = 0; i < option->values; ++i) {
        const std::string_view value = take_word(rest);
        if (word == "-clamp") use.clamps = value == "on";
      }
      if (option->shows) not_applied(word);
    }
    left = trimmed(rest);
  }
  use.name = std::string(left);
  return use;
}

/// A material while its statements are read.
struct ObjLibraries::Read {
  ObjSurface surface;
  std::string name;
  bool has_dissolve = false, has_color = false, has_emission = false;
  ObjTextureUse color, dissolve, emission;
  std::string color_place, dissolve_place, emission_place;  ///< of their statements
};

void ObjLibraries::read(const std::shared_ptr<const StreamSource>& file, const Define& define) {
  ImportReader library(file);
  if (file->has_file()) target_.also_reads(file->name());
  Read read;
  const auto finish = [&] {
    if (read.name.empty()) return;
    take_textures(read, library.name());
    define(read.name, read.surface);
  };
  std::string_view line;
  while (library.next_line(line)) {
    Material& material = read.surface.material;
    const std::string_view word = take_word(line);
    const auto take_use = [&](ObjTextureUse& use, std::string& place) {
      use = read_obj_texture(line);
      place = library.line_place();
      if (use.not_applied.empty()) return;
      if (first_option_.empty())
        first_option_ = fmt::format("options of textures are not drawn, the first, {}, in {}",
                                    use.not_applied, library.line_place());
      target_.warn(first_option_);
    };
    if (word == "newmtl") {
      finish();
      read = {};
      read.name = std::string(trimmed(without_obj_comment(line, true)));
    } else if (word == "Kd") {
      if (const auto color = read_color(line)) {
        const float alpha = material.base_color.a;
        material.base_color = {glm::vec3(*color), alpha};
        read.has_color = true;
      }
    } else if (word == "Ke") {
      if (const auto color = read_color(line)) {
        material.emission = glm::vec3(*color);
        read.has_emission = true;
      }
    } else if (word == "d" || word == "Tr") {
      const auto number = to_number(take_word(line));  // "d -halo 0.5" has a word first
      // Beside a "d" programs do not agree on which way round "Tr" counts.
      if (!number || (word == "Tr" && read.has_dissolve)) continue;
      read.has_dissolve = read.has_dissolve || word == "d";
      material.base_color.a = std::clamp(static_cast<float>(word == "d" ? *number : 1 - *number), 0.0f, 1.0f);
    } else if (word == "map_Kd") {
      take_use(read.color, read.color_place);
    } else if (word == "map_d") {
      take_use(read.dissolve, read.dissolve_place);
    } else if (word == "map_Ke") {
      take_use(read.emission, read.emission_place);
    }
  }
  finish();
}

/// What the statements of a material say of images.
void ObjLibraries::take_textures(Read& read, const std::string& place) {
  Material& material = read.surface.material;
  const bool has_color = !read.color.name.empty(), cuts = !read.dissolve.name.empty();
  std::optional<ObjTextureUse> first;
  const auto fits = [&](const ObjTextureUse& use, std::string_view what) {
    if (first && !first->has_place_of(use)) {
      target_.warn(fmt::format("{} with other options than the base colour's are not drawn", what));
      return false;
    }
    if (!first) first = use;
    return true;
  };
  if (has_color) first = read.color;
  const bool cut_fits = cuts && fits(read.dissolve, "textures of what is cut out (map_d)");
  if (has_color || cut_fits) {
    material.texture = image(has_color ? read.color.name : "", cut_fits ? read.dissolve.name : "",
                             has_color ? read.color_place : read.dissolve_place);
    if (material.texture != no_id && cut_fits) material.cutoff = dissolve_cutoff;
    if (material.texture != no_id && has_color && read.has_color &&
        glm::vec3(material.base_color) == glm::vec3(0)) {
      material.base_color = {1, 1, 1, material.base_color.a};
      target_.warn(fmt::format(
          "materials of {} have a texture and a black Kd, and are drawn as if it were white", shown(place)));
    }
    if (material.texture != no_id && has_color && !read.has_color)
      material.base_color = {1, 1, 1, material.base_color.a};
  }
  if (!read.emission.name.empty() && fits(read.emission, "emissive textures (map_Ke)")) {
    material.emission_texture = image(read.emission.name, "", read.emission_place);
    if (material.emission_texture != no_id && !read.has_emission) material.emission = glm::vec3(1);
  }
  if (!first || !read.surface.is_textured()) return;
  read.surface.scale = first->scale;
  read.surface.offset = first->offset;
  const TextureWrap wrap = first->clamps ? TextureWrap::clamp : TextureWrap::repeat;
  material.sampler = {wrap, wrap, false};
}

/// place: of the statement that names it.
std::optional<ModelImage> ObjLibraries::open(const std::string& name, const std::string& place) {
  const auto source = target_.beside(name);
  if (!source) {
    if (first_missing_.empty())
      first_missing_ =
          fmt::format("images are missing, and what they are on is drawn without, the first: {} names {}",
                      place, shown(name));
    target_.warn(first_missing_);
    return std::nullopt;
  }
  if (source->has_file()) target_.also_reads(source->name());
  return ModelImage{fmt::format("{}: image {}", place, shown(name)), [source] {
                      std::vector<std::byte> bytes(source->size());
                      if (!bytes.empty()) SourceReader(source).read(0, bytes);
                      return bytes;
                    }};
}

/// Of colours and alpha, one of which may have no name; no_id where there is none.
uint32_t ObjLibraries::image(const std::string& color, const std::string& alpha, const std::string& place) {
  const auto [found, added] = images_.try_emplace({color, alpha}, no_id);
  if (!added) return found->second;
  std::optional<ModelImage> image, alphas;
  if (!color.empty()) image = open(color, place);
  if (!alpha.empty() && alpha != color) alphas = open(alpha, place);
  if (!image && (!color.empty() || !alphas)) return no_id;
  if (!image) image.emplace(ModelImage{alphas->place, {}});
  if (alphas) image->alpha = std::make_shared<const ModelImage>(std::move(*alphas));
  if (alpha == color && !alpha.empty()) image->alpha = std::make_shared<const ModelImage>(*image);
  return found->second = target_.add_image(std::move(*image));
}

/// In linear light; nothing where it is not understood, which is said.
std::optional<glm::vec4> ObjLibraries::read_color(std::string_view line) {
  std::array<double, 3> color;
  for (size_t i = 0; i < 3; ++i) {
    const std::string_view word = take_word(line);
    if (i == 0 && (word == "xyz" || word == "spectral")) {
      target_.warn("colours in a space other than RGB are not drawn");
      return std::nullopt;
    }
    const auto number = to_number(word);
    // One number stands for all three.
    color[i] = i > 0 && word.empty() ? color[0] : number.value_or(std::numeric_limits<double>::quiet_NaN());
    if (std::isfinite(color[i])) continue;
    target_.warn("colours without three numbers are not drawn");
    return std::nullopt;
  }
  return from_display_color(color[0], color[1], color[2]);
}

}  // namespace triptych
