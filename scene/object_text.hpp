// A source object in words.
#pragma once

#include "scene/pack_objects.hpp"

#include <array>
#include <string>
#include <string_view>

namespace triptych {

/// A text of an object, and what it is called.
struct ObjectText {
  const char* name;
  uint32_t SourceObject::*text;
};
inline constexpr std::array object_texts = {
    ObjectText{"name", &SourceObject::name},   ObjectText{"type", &SourceObject::type},
    ObjectText{"layer", &SourceObject::layer}, ObjectText{"storey", &SourceObject::storey},
    ObjectText{"guid", &SourceObject::guid},   ObjectText{"number", &SourceObject::number}};

/// In one line, and no longer than so many bytes, at least 4; whole letters of UTF-8.
std::string in_one_cell(std::string_view text, size_t most);

/// What is known of an object in a few lines, indented; its first properties.
std::string object_text(const PackObjects& objects, SourceObjectId id);

}  // namespace triptych
