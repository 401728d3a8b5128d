// The XML of 3MF (core specification 1.3, materials extension): read element by element with expat.
#include "base/error.hpp"
#include "base/xml_fault.hpp"
#include "model/import/import_3mf.hpp"
#include "model/import/import_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace triptych {

namespace {

/// The name behind a namespace's prefix.
std::string_view local_name(std::string_view name) {
  const size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

class Attributes {
 public:
  explicit Attributes(const char** pairs) : pairs_(pairs) {}
  std::string_view text(std::string_view name) const {
    for (const char** pair = pairs_; pair[0]; pair += 2) {
      if (local_name(pair[0]) == name) return pair[1];
    }
    return {};
  }
  std::optional<uint64_t> number(std::string_view name) const {
    const auto value = to_integer(trimmed(text(name)));
    return value && *value >= 0 ? std::optional(static_cast<uint64_t>(*value)) : std::nullopt;
  }
  /// NaN where there is no number.
  double coordinate(std::string_view name) const {
    return to_number(trimmed(text(name))).value_or(std::numeric_limits<double>::quiet_NaN());
  }

 private:
  const char** pairs_;
};

double metres_of(std::string_view unit, FileImport& target) {
  static constexpr std::array<std::pair<std::string_view, double>, 7> units = {{{"", 0.001},
                                                                                {"micron", 1e-6},
                                                                                {"millimeter", 0.001},
                                                                                {"centimeter", 0.01},
                                                                                {"inch", 0.0254},
                                                                                {"foot", 0.3048},
                                                                                {"meter", 1}}};
  for (const auto& [name, metres] : units) {
    if (unit == name) return metres;
  }
  target.warn("units are not known; millimetres were taken");
  return 0.001;
}

/// Twelve numbers: where x, y, z and the origin go. The identity where there are none.
Affine transform_of(std::string_view text, FileImport& target) {
  if (trimmed(text).empty()) return Affine(1);
  Affine transform(1);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      const auto number = to_number(take_word(text));
      if (!number || !std::isfinite(*number)) {
        target.warn("transforms without twelve numbers were left out");
        return Affine(1);
      }
      transform[column][row] = *number;
    }
  }
  return transform;
}

/// "#RRGGBB" or "#RRGGBBAA".
std::optional<uint32_t> color_of(std::string_view text) {
  text = trimmed(text);
  if (text.size() < 7 || text[0] != '#') return std::nullopt;
  uint32_t color = 0;
  for (const char letter : text.substr(1, 6)) {
    const char* digits = "0123456789abcdef";
    const char* digit = std::strchr(digits, letter >= 'A' && letter <= 'F' ? letter + 32 : letter);
    if (!digit || letter == '\0') return std::nullopt;
    color = color << 4 | static_cast<uint32_t>(digit - digits);
  }
  return color;
}

class PartParser {
 public:
  PartParser(ThreeMfPart& part, FileImport& target) : part_(part), target_(target) {}

  void begin(std::string_view name, const Attributes& attributes) {
    if (name == "vertex") {
      if (object_)
        object_->positions.emplace_back(attributes.coordinate("x"), attributes.coordinate("y"),
                                        attributes.coordinate("z"));
    } else if (name == "triangle") {
      if (object_) add_triangle(attributes);
    } else if (name == "model") {
      part_.metres = metres_of(attributes.text("unit"), target_);
    } else if (name == "object") {
      begin_object(attributes);
    } else if (name == "component" || name == "item") {
      add_use(name == "item", attributes);
    } else if (name == "basematerials" || name == "colorgroup") {
      group_ = &part_.colors[attributes.number("id").value_or(0)];
    } else if (name == "base" || name == "color") {
      const auto color = color_of(attributes.text(name == "base" ? "displaycolor" : "color"));
      if (group_) group_->push_back(color.value_or(0xcccccc));
    } else if (name == "texture2d" || name == "compositematerials" || name == "multiproperties") {
      target_.warn("textures and mixed materials are not drawn");
    } else if (name == "beamlattice" || name == "slicestack") {
      target_.warn("beam lattices and slices are not drawn");
    }
  }

  void end(std::string_view name) {
    if (name == "object") end_object();
    if (name == "basematerials" || name == "colorgroup") group_ = nullptr;
  }

 private:
  void begin_object(const Attributes& attributes) {
    const auto id = attributes.number("id");
    if (!id) return target_.warn("objects without an id were skipped");
    object_ = &part_.objects[*id];
    *object_ = {};
    object_->name = std::string(attributes.text("name"));
    object_->guid = std::string(attributes.text("UUID"));
    object_->part_number = std::string(attributes.text("partnumber"));
    const std::string_view type = attributes.text("type");
    object_->is_support = type == "support" || type == "other";
    if (const auto group = attributes.number("pid"))
      object_->color = ThreeMfColor{*group, attributes.number("pindex").value_or(0)};
  }

  /// Checks the triangles once the vertices are known.
  void end_object() {
    if (!object_) return;
    const auto dropped = std::erase_if(object_->triangles, [&](const ThreeMfTriangle& triangle) {
      return std::any_of(triangle.vertices.begin(), triangle.vertices.end(),
                         [&](uint32_t vertex) { return vertex >= object_->positions.size(); });
    });
    target_.warn("triangles that name vertices which are not there were skipped", dropped);
    object_ = nullptr;
  }

  void add_triangle(const Attributes& attributes) {
    constexpr uint64_t none = std::numeric_limits<uint32_t>::max();
    ThreeMfTriangle triangle{{}, object_->color};
    for (size_t i = 0; i < 3; ++i) {
      static constexpr std::array names = {"v1", "v2", "v3"};
      triangle.vertices[i] =
          static_cast<uint32_t>(std::min(attributes.number(names[i]).value_or(none), none));
    }
    const auto group = attributes.number("pid");
    const auto index = attributes.number("p1");
    // Of three colours the first one is taken.
    if (group) triangle.color = ThreeMfColor{*group, index.value_or(0)};
    if (!group && index && object_->color) triangle.color = ThreeMfColor{object_->color->group, *index};
    if (index && attributes.number("p2").value_or(*index) != *index)
      target_.warn("triangles with several colours are drawn in the first one");
    object_->triangles.push_back(triangle);
  }

  void add_use(bool is_item, const Attributes& attributes) {
    const auto object = attributes.number("objectid");
    if (!object) return target_.warn("items without an object were skipped");
    ThreeMfUse use{std::string(attributes.text("path")), *object,
                   transform_of(attributes.text("transform"), target_), std::string(attributes.text("UUID")),
                   std::string(attributes.text("partnumber"))};
    if (is_item && attributes.text("printable") == "0")
      target_.warn("items are marked as not to be printed; they are drawn");
    if (is_item) {
      part_.items.push_back(std::move(use));
    } else if (object_) {
      object_->components.push_back(std::move(use));
    }
  }

  ThreeMfPart& part_;
  FileImport& target_;
  ThreeMfObject* object_ = nullptr;         ///< whose element is open
  std::vector<uint32_t>* group_ = nullptr;  ///< of colours, whose element is open
};

}  // namespace

ThreeMfPart parse_3mf_part(const std::shared_ptr<const StreamSource>& source, FileImport& target) {
  ThreeMfPart part;
  PartParser handler(part, target);
  const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreate(nullptr),
                                                                       XML_ParserFree);
  if (!parser) fail(source->name(), "there is no memory for its parser");
  XML_SetUserData(parser.get(), &handler);
  XML_SetElementHandler(
      parser.get(),
      [](void* data, const char* name, const char** attributes) {
        static_cast<PartParser*>(data)->begin(local_name(name), Attributes(attributes));
      },
      [](void* data, const char* name) { static_cast<PartParser*>(data)->end(local_name(name)); });
  SourceReader reader(source);
  std::vector<std::byte> block(size_t{1} << 18);
  bool good = true;
  for (uint64_t offset = 0; good && offset <= source->size();) {
    const auto count = static_cast<size_t>(std::min<uint64_t>(block.size(), source->size() - offset));
    reader.read(offset, std::span(block).first(count));
    offset += count;
    const bool last = offset == source->size();
    good = XML_Parse(parser.get(), reinterpret_cast<const char*>(block.data()), static_cast<int>(count),
                     last) == XML_STATUS_OK;
    if (last) break;
  }
  if (good) return part;
  const std::string what = xml_fault(parser.get());
  handler.end("object");
  if (part.objects.empty()) fail(source->name(), "{}", what);
  target.remark(what + "; what stands before was read");
  return part;
}

}  // namespace triptych
