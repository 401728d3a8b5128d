// What a person hides and cuts away, with one history of both.
#pragma once

#include "base/clock.hpp"
#include "view/hider.hpp"
#include "view/sections.hpp"
#include "view/tour.hpp"

#include <optional>
#include <string>
#include <vector>

namespace triptych {

/// What of a model is to be seen.
struct Sight {
  Hiding hiding;
  Section section;
  bool operator==(const Sight&) const = default;
};

/// Steps back, and forward again until something else is done. Pure but for the clock.
class SightHistory {
 public:
  /// Something is changed; was: what was to be seen before. goes_on: it goes on with the last change, if that
  /// also went on and was a moment ago: both are one step.
  void change(const Sight& was, bool goes_on = false);
  /// now: what is to be seen. Nullopt where there is no step.
  std::optional<Sight> undo(const Sight& now);
  std::optional<Sight> redo(const Sight& now);

  static constexpr size_t most_steps = 100;

 private:
  std::vector<Sight> before_, after_;
  bool goes_on_ = false;
  Stopwatch since_change_;
};

/// Of one pack, which must outlive it.
class Edits {
 public:
  Edits(const Skeleton& skeleton, Hiding hiding, const Section& section)
      : hider_(skeleton, std::move(hiding)), sections_(section, skeleton.diagonal()) {}

  static bool takes(Command command);
  /// Does what such a command says to what is selected, or is under the cursor. Returns what there is to say;
  /// empty: nothing.
  std::string take(Command command, Tour& tour, const CursorPlace& cursor);
  /// Sections::move().
  void move(double steps, const glm::dvec3& eye);
  /// As if it had been so at first.
  void begin_at(Hiding hiding, const Section& section);

  const Hiding& hiding() const { return hider_.hiding(); }
  const Section& section() const { return sections_.section(); }
  /// Sections::words().
  std::string words() const { return sections_.words(); }

 private:
  Sight sight() const { return {hiding(), section()}; }

  Hider hider_;
  Sections sections_;
  SightHistory history_;
};

}  // namespace triptych
