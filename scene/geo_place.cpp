#include "scene/geo_place.hpp"

#include "base/bytes.hpp"
#include "base/error.hpp"

#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

void check_geo_place(const GeoPlace& geo_place, const std::string& place) {
  if (!(std::abs(geo_place.latitude) <= 90) || !(std::abs(geo_place.longitude) <= 180))
    fail(place, "latitude {} and longitude {} are no place on Earth: they are within 90 and 180 degrees",
         geo_place.latitude, geo_place.longitude);
  if (!std::isfinite(geo_place.elevation)) fail(place, "the elevation is no number");
  constexpr double tolerance = 1e-9;
  if (!(std::abs(glm::length(geo_place.north) - 1) <= tolerance))
    fail(place, "the direction to north is not of length 1");
}

GeoPlace parse_geo_place(const std::string& text, const std::string& place) {
  GeoPlace result;
  const char* const end = text.data() + text.size();
  const auto latitude = std::from_chars(text.data(), end, result.latitude);
  const bool separated = latitude.ec == std::errc() && latitude.ptr != end && *latitude.ptr == ',';
  const auto longitude = separated ? std::from_chars(latitude.ptr + 1, end, result.longitude) : latitude;
  if (!separated || longitude.ec != std::errc() || longitude.ptr != end)
    fail(place, "\"{}\" is no place as 48.137,11.575: degrees north and east", text);
  check_geo_place(result, place);
  return result;
}

std::vector<std::byte> encode_geo_place(const GeoPlace& geo_place) {
  ByteWriter writer;
  for (const double value :
       {geo_place.latitude, geo_place.longitude, geo_place.elevation, geo_place.north.x, geo_place.north.y})
    writer.write(value);
  return std::move(writer.bytes());
}

GeoPlace decode_geo_place(std::span<const std::byte> bytes, const std::string& place) {
  ByteReader reader(bytes, place);
  GeoPlace result;
  for (double* const value :
       {&result.latitude, &result.longitude, &result.elevation, &result.north.x, &result.north.y})
    *value = reader.read<double>();
  reader.expect_end();
  check_geo_place(result, place);
  return result;
}

}  // namespace triptych
