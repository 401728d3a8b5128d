// A hard case: a small scene with cameras on which something breaks easily, and the faults that it catches.
#pragma once

#include "model/model.hpp"
#include "preprocess/build.hpp"
#include "scene/frame_state.hpp"
#include "scene/section.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace triptych::hard_cases {

/// What a case is tried on. All views have one size.
struct Trial {
  Model model;
  std::vector<View> views;
  double pixel_error = 1;
  /// Of the views by turns; none: nothing is cut. Pictures alone are tried under them.
  std::vector<Section> sections = {};
  Section section_of(size_t view) const {
    return sections.empty() ? Section() : sections[view % sections.size()];
  }
  std::vector<double> times = {};  ///< of the views, seconds; none: 0
  FrameState state_of(size_t view) const {
    FrameState state{views[view], pixel_error};
    state.section = section_of(view);
    if (!times.empty()) state.time = times[view];
    return state;
  }
  BuildOptions build{.part_triangles = 64, .leaf_triangles = 64, .hlod_triangles = 48};
  bool may_be_empty = false;  ///< no frame has to show anything
  bool stands_still = false;  ///< all views are the same: nothing may change after the first frames
  bool oriented = false;      ///< closed meshes, their outsides out: levels of detail must not turn them over
  bool slivers = false;       ///< has triangles whose depth leaves their box, and with it the picture
  bool thin = false;          ///< backs have the depth of the fronts before them somewhere, to a float
  bool no_blue =
      false;  ///< up to a pixel error of 1 no pixel may show blue: what is blue lies under something
  bool closed = false;  ///< at no pixel error may a view show the background where full detail does not
  size_t left_out = 0;  ///< placements that the build has to count as left out
  size_t max_drawables = ~size_t{0};  ///< that the build may come to
  /// For each view the objects that are hidden, ids of Model::source_objects; nothing where it is empty.
  std::vector<std::vector<SourceObjectId>> hidden = {};
  /// Another model and other views that must give the same pictures, pixel for pixel.
  std::shared_ptr<Trial> twin = nullptr;
  /// Path files that must be refused with one line that names their frame 0; then there are no views.
  std::vector<std::string> refused_paths = {};
};

struct HardCase {
  std::string name;    ///< of its file
  std::string group;   ///< far, depth, boxes, views, occlusion, geometry, touching, sections, numbers
  std::string breaks;  ///< one sentence: what breaks there
  /// Names for --inject; joined by + where it takes several at once. The case must fail under each.
  std::vector<std::string> faults;
  std::function<Trial()> make;
};

/// Every case, by name. Cases enter it when the program starts.
const std::vector<HardCase>& gallery();

/// Defined at file scope, enters the case into the gallery.
struct InGallery {
  explicit InGallery(HardCase hard_case);
};

}  // namespace triptych::hard_cases
