// Viewpoints as programs for buildings exchange them: BCF (BIM Collaboration Format) of buildingSMART, read
// in versions 2.1 and 3.0, written in 2.1.
#pragma once

#include "scene/path.hpp"
#include "scene/section.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// What one viewpoint of a file says. All places are the pack's: metres, y up; in BCF they are metres with
/// z up.
struct Viewpoint {
  std::string title;                    ///< of the topic
  PathFrame camera;                     ///< symmetric; the height of the picture is what counts
  std::vector<std::string> selected;    ///< IFC GUIDs
  bool shows_others = true;             ///< whether what is not named in `exceptions` is to be seen
  std::vector<std::string> exceptions;  ///< IFC GUIDs of what is hidden, or else of all that is shown
  std::vector<SectionPlane> planes;
  /// What else it has, which is not read: "colours", "lines", "bitmaps".
  std::vector<std::string> left_out;
};

/// All viewpoints of all topics, in the order of the file. Error (file, member in it) for what is no zip
/// archive or no BCF, for members that are missing, encrypted, damaged or unpack to more than 16 MiB, for
/// broken XML, for viewpoints without a camera or with numbers that are none, and where there is none at all.
std::vector<Viewpoint> read_bcf(const std::filesystem::path& file);

/// One topic with one viewpoint. snapshot: a PNG file's bytes; none where it is empty. time: of creation, as
/// "2024-05-01T12:00:00Z". Error (file) where it cannot be written. An off-axis camera is an Error too: BCF
/// has none.
void write_bcf(const std::filesystem::path& file, const Viewpoint& viewpoint,
               std::span<const std::byte> snapshot, const std::string& time);

/// Its planes as a section; the six sides of a box along the axes are that box. Error (place) for more planes
/// than there may be.
Section section_of(const Viewpoint& viewpoint, const std::string& place);
/// A section's planes and the sides of its box.
std::vector<SectionPlane> planes_of(const Section& section);

}  // namespace triptych
