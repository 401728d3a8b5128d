// Sets of hidden objects that came as messages, for the frames that name them.
#pragma once

#include "protocol/messages.hpp"
#include "scene/pack.hpp"
#include "scene/pack_objects.hpp"

#include <deque>
#include <optional>

namespace triptych {

/// Keeps the last few sets, applied to the pack, which must outlive it: at most two frames are in flight, and
/// a set is sent again where another one was sent meanwhile. Reads the pack's objects with the first set.
class HiddenSets {
 public:
  explicit HiddenSets(const Pack& pack) : pack_(pack) {}

  /// Error (place: hidden set) for one that is not of this pack; of the pack where its objects are damaged.
  void add(const HiddenSet& set);
  /// Gives a frame state that came over the network the set that it names. Error (place: hidden set) where
  /// that did not come.
  void complete(FrameState& state) const;

 private:
  static constexpr size_t most = 4;

  const Pack& pack_;
  std::optional<PackObjects> objects_;
  std::deque<Hiding> sets_;  ///< the last that came stands last
};

}  // namespace triptych
