// What a person clicked on, in words.
#pragma once

#include "scene/frame_state.hpp"
#include "scene/pack_objects.hpp"
#include "view/picker.hpp"

#include <optional>
#include <string>

namespace triptych {

struct Selection {
  SourceObjectId object = no_id;  ///< no_id where the model's files name none
  std::string name;               ///< of the object, for a title; where the model names none, of the drawable
  std::string text;               ///< all that is known, in a few lines
  Box box;                        ///< of the object, or of the scene node, model space
};

/// Reads the pack's objects when it is first asked. The pack must outlive it.
class Selector {
 public:
  explicit Selector(const Pack& pack) : pack_(pack) {}
  /// frame: the one in which it was picked. Error for a damaged section.
  Selection describe(const Picked& picked, const FrameState& frame);
  const PackObjects& objects();

 private:
  const Pack& pack_;
  std::optional<PackObjects> objects_;
};

}  // namespace triptych
