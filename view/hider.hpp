// What a person at the window has hidden: by object, layer, storey and file, step by step.
#pragma once

#include "scene/hidden_objects.hpp"
#include "view/window.hpp"

#include <string>
#include <vector>

namespace triptych {

/// Of one pack, which must outlive it.
class Hider {
 public:
  Hider(const Skeleton& skeleton, Hiding at_first) : skeleton_(skeleton), hiding_(std::move(at_first)) {}

  /// Whether the command hides or shows something.
  static bool takes(Command command);
  /// Does what such a command says; selected: the object that it is about, no_id for none. Returns what
  /// there is to say where it does nothing.
  std::string take(Command command, const PackObjects& objects, SourceObjectId selected);

  const Hiding& hiding() const { return hiding_; }
  /// As if that had been hidden at first.
  void begin_at(Hiding hiding) { hiding_ = std::move(hiding); }

 private:
  static constexpr size_t most_remembered = 100;

  void change(Hiding to);

  const Skeleton& skeleton_;
  Hiding hiding_;
  std::vector<Hiding> before_;  ///< for Command::undo_hiding
};

}  // namespace triptych
