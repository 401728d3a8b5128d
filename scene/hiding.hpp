// What a person has hidden, as a part of the frame state.
#pragma once

#include "scene/skeleton.hpp"

#include <cstdint>
#include <memory>
#include <span>

namespace triptych {

class HiddenObjects;

/// Names a set of hidden source objects on every machine: how many they are, and a hash of their ids. Both
/// are 0 where nothing is hidden.
struct HiddenName {
  uint32_t count = 0;
  uint64_t hash = 0;
  bool operator==(const HiddenName&) const = default;
};

/// Of ids of source objects, ascending, each once.
HiddenName hidden_name(std::span<const uint32_t> objects);

/// What is hidden in a frame: it neither shows nor hides anything. A plain value; sets are shared.
struct Hiding {
  HiddenName name;
  /// The set of that name, applied to the pack. Null where nothing is hidden, and where only the name came
  /// over the network: nobody can draw such a frame until the set is there (scene/hidden_objects.hpp).
  std::shared_ptr<const HiddenObjects> objects = nullptr;
  bool operator==(const Hiding& other) const { return name == other.name; }
};

}  // namespace triptych
