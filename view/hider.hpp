// What a person at the window has hidden: by object, layer, storey and file.
#pragma once

#include "scene/hidden_objects.hpp"
#include "view/window.hpp"

#include <span>
#include <string>

namespace triptych {

/// Of one pack, which must outlive it.
class Hider {
 public:
  Hider(const Skeleton& skeleton, Hiding at_first) : skeleton_(skeleton), hiding_(std::move(at_first)) {}

  /// Whether the command hides or shows something.
  static bool takes(Command command);
  /// Does what such a command says; selected: the objects that it is about. Returns what there is to say
  /// where it does nothing.
  std::string take(Command command, const PackObjects& objects, std::span<const SourceObjectId> selected);

  const Hiding& hiding() const { return hiding_; }
  void begin_at(Hiding hiding) { hiding_ = std::move(hiding); }

 private:
  const Skeleton& skeleton_;
  Hiding hiding_;
};

}  // namespace triptych
