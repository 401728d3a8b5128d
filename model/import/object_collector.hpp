// Collects the objects of one file into the model, each text once.
#pragma once

#include "scene/source_objects.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tsl/robin_set.h>
#include <utility>
#include <vector>

namespace triptych {

/// What a file says of an object; empty where it says nothing.
struct ObjectTexts {
  std::string_view name, type = {}, guid = {}, layer = {}, storey = {}, number = {};
};

class ObjectCollector {
 public:
  /// `place`: of errors.
  ObjectCollector(SourceObjects& objects, std::string place);
  ObjectCollector(const ObjectCollector&) = delete;

  /// The parent must have been added before. Error (place) for more text than the model can hold.
  SourceObjectId add(const ObjectTexts& texts, SourceObjectId parent = no_id,
                     std::span<const uint32_t> property_sets = {});
  /// Names and values; the set's number, for objects that have it.
  uint32_t add_set(std::string_view name, std::span<const std::pair<std::string, std::string>> properties);

 private:
  uint32_t number_of(std::string_view text);

  struct Hash {
    using is_transparent = void;
    const TextTable* texts;
    size_t operator()(std::string_view text) const { return std::hash<std::string_view>()(text); }
    size_t operator()(uint32_t text) const { return (*this)((*texts)[text]); }
  };
  struct Equal {
    using is_transparent = void;
    const TextTable* texts;
    bool operator()(uint32_t one, uint32_t other) const { return one == other; }
    bool operator()(std::string_view one, uint32_t other) const { return one == (*texts)[other]; }
    bool operator()(uint32_t one, std::string_view other) const { return (*texts)[one] == other; }
  };

  SourceObjects& objects_;
  std::string place_;
  tsl::robin_set<uint32_t, Hash, Equal> known_;
};

}  // namespace triptych
