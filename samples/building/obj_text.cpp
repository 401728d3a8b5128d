#include "samples/building/obj_text.hpp"

#include "base/error.hpp"

#include <charconv>
#include <cmath>

namespace triptych {
namespace {

/// The words of a text, line by line.
class Lines {
 public:
  Lines(std::string_view text, const std::string& place) : text_(text), place_(place) {}

  bool next() {
    if (at_ >= text_.size()) return false;
    size_t end = text_.find('\n', at_);
    if (end == std::string_view::npos) end = text_.size();
    line_ = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++number_;
    return true;
  }

  std::string_view word() {
    const size_t begin = line_.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return line_ = {};
    line_.remove_prefix(begin);
    const auto result = line_.substr(0, line_.find_first_of(" \t\r"));
    line_.remove_prefix(result.size());
    return result;
  }

  /// What is left of the line, without blanks around it: names may contain blanks.
  std::string_view rest() {
    const size_t begin = line_.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return line_.substr(begin, line_.find_last_not_of(" \t\r") + 1 - begin);
  }

  double number() {
    const auto text = word();
    double value = 0;
    const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end.ec != std::errc() || end.ptr != text.data() + text.size() || !std::isfinite(value))
      fail(place_, "line {}: '{}' is not a number", number_, text);
    return value;
  }

  glm::dvec3 three_numbers() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }

  [[noreturn]] void bad(std::string_view what, std::string_view word) const {
    fail(place_, "line {}: {} '{}'", number_, what, word);
  }

 private:
  std::string_view text_, line_;
  const std::string& place_;
  size_t at_ = 0;
  int number_ = 0;
};

uint32_t corner(const Lines& lines, std::string_view word, size_t position_count) {
  int64_t index = 0;
  const auto end = std::from_chars(word.data(), word.data() + word.size(), index);
  const bool whole = end.ptr == word.data() + word.size() || *end.ptr == '/';
  if (end.ec != std::errc() || !whole) lines.bad("no vertex index:", word);
  const auto count = static_cast<int64_t>(position_count);
  if (index < 0) index += count + 1;
  if (index < 1 || index > count) lines.bad("vertex index out of range:", word);
  return static_cast<uint32_t>(index - 1);
}

}  // namespace

ObjModel parse_obj(std::string_view text, const std::string& place) {
  ObjModel model;
  std::map<std::string, size_t, std::less<>> numbers;
  const auto material = [&](std::string_view name) {
    const auto [found, added] = numbers.try_emplace(std::string(name), model.materials.size());
    if (added) {
      model.materials.emplace_back(name);
      model.polygons.emplace_back();
    }
    return found->second;
  };
  std::string_view current = "";
  size_t number = SIZE_MAX;
  Lines lines(text, place);
  while (lines.next()) {
    const auto keyword = lines.word();
    if (keyword == "v") {
      model.positions.push_back(lines.three_numbers());
    } else if (keyword == "f") {
      if (number == SIZE_MAX) number = material(current);
      ObjPolygons& polygons = model.polygons[number];
      uint32_t size = 0;
      for (auto word = lines.word(); !word.empty(); word = lines.word(), ++size)
        polygons.corners.push_back(corner(lines, word, model.positions.size()));
      polygons.sizes.push_back(size);
    } else if (keyword == "usemtl") {
      current = lines.rest();
      number = SIZE_MAX;
    } else if (keyword == "mtllib") {
      model.material_libraries.emplace_back(lines.rest());
    }
  }
  return model;
}

std::map<std::string, ObjMaterial> parse_mtl(std::string_view text, const std::string& place) {
  std::map<std::string, ObjMaterial> materials;
  ObjMaterial* material = nullptr;
  Lines lines(text, place);
  while (lines.next()) {
    const auto keyword = lines.word();
    if (keyword == "newmtl") {
      material = &materials[std::string(lines.rest())];
    } else if (material && keyword == "Kd") {
      material->diffuse = lines.three_numbers();
    } else if (material && keyword == "d") {
      material->opacity = lines.number();
    } else if (material && keyword == "map_Kd") {
      material->texture = lines.rest();
    }
  }
  return materials;
}

}  // namespace triptych
