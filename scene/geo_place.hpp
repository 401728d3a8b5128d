// Where on Earth a model stands.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

namespace triptych {

struct GeoPlace {
  double latitude = 0, longitude = 0;  ///< degrees; north and east are positive
  double elevation = 0;                ///< metres above the sea
  /// The direction to true north in model space, horizontal (x and z), of length 1. Models are y up.
  glm::dvec2 north{0, -1};
  bool operator==(const GeoPlace&) const = default;
};

/// Error (place) unless latitude is within 90 degrees, longitude within 180, elevation finite, and north of
/// length 1.
void check_geo_place(const GeoPlace& geo_place, const std::string& place);

/// "48.137,11.575": degrees, latitude first. Error (place) for another text.
GeoPlace parse_geo_place(const std::string& text, const std::string& place);

/// The bytes of the pack's section SKYL.
std::vector<std::byte> encode_geo_place(const GeoPlace& geo_place);
/// Error (place) for bytes that are no such section.
GeoPlace decode_geo_place(std::span<const std::byte> bytes, const std::string& place);

}  // namespace triptych
