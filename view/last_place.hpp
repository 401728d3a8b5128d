// Where a person stands, kept in a file for the process that goes on in a window where this one ended.
#pragma once

#include "base/clock.hpp"
#include "scene/hidden_objects.hpp"
#include "scene/path.hpp"
#include "scene/section.hpp"
#include "scene/source_objects.hpp"
#include "view/measurement.hpp"
#include "view/picker.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

struct LastPlace {
  PathFrame camera;
  double pace = 1;  ///< Walker::pace()
  double pixel_error = 1;
  bool edges = false, culling = true;
  std::vector<SourceObjectId> selected = {};
  std::vector<Picked> picked = {};  ///< what is selected of no object
  Section section = {};
  ObjectSet hidden = {};
  std::vector<Measured> measured = {};  ///< Measuring::all()
};

std::string last_place_text(const LastPlace& place);
/// Error (place) for a text that last_place_text() does not write.
LastPlace parse_last_place(const std::string& text, const std::string& place);

/// The file; without one, nothing is kept.
class PlaceKeeper {
 public:
  explicit PlaceKeeper(std::filesystem::path file) : file_(std::move(file)) {}

  /// What an earlier process kept; nullopt where there was none. A file that is damaged is said, and none.
  std::optional<LastPlace> read() const;
  /// Writes it, if it is another, at most four times a second; a failure is said once. True where it is kept.
  bool keep(const LastPlace& place);
  bool wanted() const { return !file_.empty(); }

 private:
  std::filesystem::path file_;
  std::string kept_;
  Stopwatch since_;
  bool failed_ = false;
};

}  // namespace triptych
