// What a person clicked on or searched for, in words.
#pragma once

#include "scene/frame_state.hpp"
#include "scene/pack_objects.hpp"
#include "view/picker.hpp"

#include <optional>
#include <string>
#include <vector>

namespace triptych {

struct Selection {
  std::string name;  ///< of the object, for a title; where the model names none, of the drawable
  std::string text;  ///< all that is known, in a few lines
  Box box;           ///< of the object, or of the placement, model space; empty where it shows nothing
  SourceObjectId object = no_id;   ///< no_id where the model's files name none
  std::optional<Picked> picked{};  ///< where it was clicked on; nullopt where it was searched for
  uint64_t triangles = 0;          ///< placed ones, at full detail
};

/// Whether both are of the same object, or of the same placement of the same drawable where there is none.
bool same_thing(const Selection& a, const Selection& b);

/// Reads the pack's objects when it is first asked. The pack must outlive it.
class Selector {
 public:
  explicit Selector(const Pack& pack) : pack_(pack) {}
  /// frame: the one in which it was picked. Error for a damaged section.
  Selection describe(const Picked& picked, const FrameState& frame);
  /// An object, wherever it is.
  Selection describe(SourceObjectId object);
  const PackObjects& objects();
  /// Those that show it: the object itself, or where it has no geometry of its own what is in it.
  std::vector<SourceObjectId> parts_of(SourceObjectId object);

 private:
  void add_object(SourceObjectId object, Selection& selection);
  void add_placement(SceneNodeId leaf, uint32_t placement, Selection& selection) const;

  const Pack& pack_;
  std::optional<PackObjects> objects_;
};

}  // namespace triptych
