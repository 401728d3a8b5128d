// What the files of a model say of the things in it: names, kinds, GUIDs, layers, storeys, properties.
#pragma once

#include "scene/skeleton.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

/// Names a thing as a file has it: a product of IFC, a node of glTF, an insert of DXF. What the build makes
/// of their geometry (ObjectCounts) are other objects.
using SourceObjectId = uint32_t;

/// Texts by number, as files give them, usually UTF-8. Text 0 is empty.
class TextTable {
 public:
  /// Of all texts together, at most: files of any size hold far less.
  static constexpr uint64_t max_bytes = uint64_t{1} << 30;

  uint32_t size() const { return static_cast<uint32_t>(ends_.size()); }
  uint64_t bytes() const { return bytes_.size(); }
  std::string_view operator[](uint32_t text) const {
    const uint32_t begin = text == 0 ? 0 : ends_[text - 1];
    return std::string_view(bytes_).substr(begin, ends_[text] - begin);
  }
  /// The number of the new text; all of them together must stay below max_bytes.
  uint32_t add(std::string_view text);

 private:
  std::string bytes_;
  std::vector<uint32_t> ends_ = {0};
};

/// The first six are numbers of texts; the empty one where the file says nothing.
struct SourceObject {
  uint32_t name = 0;
  uint32_t type = 0;  ///< "IfcWall", or the part that is placed
  uint32_t guid = 0;
  uint32_t layer = 0, storey = 0;
  uint32_t number = 0;            ///< as the file numbers it: "#123"
  SourceObjectId parent = no_id;  ///< the object that it is in, smaller than its own id
  uint32_t first_set = 0;         ///< index into SourceObjects::set_uses; up to the next object's
  bool operator==(const SourceObject&) const = default;
};

/// Numbers of texts.
struct SourceProperty {
  uint32_t name = 0, value = 0;
  bool operator==(const SourceProperty&) const = default;
};

struct SourcePropertySet {
  uint32_t name = 0;            ///< number of a text
  uint32_t first_property = 0;  ///< index into SourceObjects::properties; up to the next set's
  bool operator==(const SourcePropertySet&) const = default;
};

/// All objects of a model. Many objects can share a property set.
struct SourceObjects {
  TextTable texts;
  std::vector<SourceObject> objects;
  std::vector<uint32_t> set_uses;  ///< object by object: indices into `sets`
  std::vector<SourcePropertySet> sets;
  std::vector<SourceProperty> properties;  ///< set by set

  bool empty() const { return objects.empty(); }
  std::span<const uint32_t> sets_of(SourceObjectId object) const;
  std::span<const SourceProperty> properties_of(uint32_t set) const;
  /// The names of the objects that it is in, from the outermost: "Hall / Roof". Empty if it is in none.
  std::string path_of(SourceObjectId object) const;
};

/// The object that a local id names in a group or sub-hierarchy whose ids count from `first`; no_id where
/// either is.
inline SourceObjectId object_in(SourceObjectId first, SourceObjectId local) {
  return first == no_id || local == no_id ? no_id : first + local;
}

}  // namespace triptych
