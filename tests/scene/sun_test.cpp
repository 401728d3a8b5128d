// Where the sun stands, against positions that were published, and moments as people write them.
#include "scene/sun.hpp"

#include "base/error.hpp"
#include "scene/geo_place.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

double moment(const std::string& text) { return parse_moment(text, "--date"); }

std::string error_of(const std::string& text) {
  try {
    moment(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Sun, stands_where_published_positions_say) {
  struct Position {
    const char* what;
    double latitude, longitude;
    const char* date;
    double altitude, azimuth;  ///< NaN: not published
  };
  const double any = std::nan("");
  const Position positions[] = {
      {"NREL, Solar Position Algorithm (Reda and Andreas, 2008), appendix A.5, before refraction", 39.742476,
       -105.1786, "2003-10-17T12:30:30-07:00", 39.872046, 194.340241},
      {"Meeus, example 25.a, the declination, which is the altitude at the pole", 90, 0, "1992-10-13T00:00Z",
       -7.78507, any},
      {"the March equinox of 2024, 03:06 UT, at the pole", 90, 0, "2024-03-20T03:06Z", 0, any},
      {"the June solstice of 2026 at Greenwich, at noon by the equation of time", 51.4769, 0,
       "2026-06-21T12:01:50Z", 90 - 51.4769 + 23.4361, 180},
      {"the December solstice of 2025 in Sydney, the sun in the north", -33.8688, 151.2093,
       "2025-12-21T01:53:00Z", 90 - 33.8688 + 23.4361, 360}};
  constexpr double tolerance = 0.1;
  for (const Position& position : positions) {
    const SunPosition sun = sun_position(position.latitude, position.longitude, moment(position.date));
    EXPECT_NEAR(sun.altitude, position.altitude, tolerance) << position.what;
    if (std::isnan(position.azimuth)) continue;
    // Near the zenith a little time is much azimuth: what counts is the angle in the sky.
    const double turn =
        std::remainder(sun.azimuth - position.azimuth, 360) * std::cos(sun.altitude * M_PI / 180);
    EXPECT_NEAR(turn, 0, tolerance) << position.what << ": azimuth " << sun.azimuth;
  }
}

TEST(Sun, is_a_direction_in_the_model_by_where_its_north_is) {
  GeoPlace place{39.742476, -105.1786, 1830, {0, -1}};
  const double at = moment("2003-10-17T19:30:30Z");
  const Sky sky = sky_over(place, at);
  EXPECT_TRUE(sky.shown);
  const double altitude = 39.872046 * M_PI / 180, azimuth = 194.340241 * M_PI / 180;
  const glm::dvec3 expected(std::cos(altitude) * std::sin(azimuth), std::sin(altitude),
                            -std::cos(altitude) * std::cos(azimuth));
  EXPECT_LT(glm::length(sky.to_sun - expected), 0.001) << "east is x, north is -z";
  EXPECT_NEAR(glm::length(sky.to_sun), 1, 1e-12);
  place.north = {1, 0};
  const glm::dvec3 turned = sky_over(place, at).to_sun;
  EXPECT_LT(glm::length(turned - glm::dvec3(-expected.z, expected.y, expected.x)), 0.001)
      << "with north at x east is z";
}

TEST(Sun, moments_are_read_with_seconds_and_zones_and_written_back) {
  EXPECT_EQ(moment("1970-01-01T00:00Z"), 0);
  EXPECT_EQ(moment("2026-06-21T15:00Z"), 1782054000);
  EXPECT_EQ(moment("2026-06-21T17:00+02:00"), 1782054000);
  EXPECT_EQ(moment("2026-06-21T09:30:00.250-05:30"), 1782054000.25);
  for (const char* text : {"2026-06-21T15:00:00.000Z", "1950-12-31T23:59:59.125Z"})
    EXPECT_EQ(moment_text(moment(text)), text);
  for (const char* wrong :
       {"", "2026-06-21", "2026-06-21T15:00", "2026-13-21T15:00Z", "2026-02-30T15:00Z", "2026-06-21T25:00Z",
        "2026-06-21T15:60Z", "2026-6-21T15:00Z", "2026-06-21T15:00+99:00", "2026-06-21T15:00Zulu", "now"})
    EXPECT_NE(error_of(wrong).find("is no moment as 2026-06-21T15:00Z"), std::string::npos) << wrong;
  EXPECT_NE(error_of("1492-10-12T12:00Z").find("1900 to 2100"), std::string::npos);
}

TEST(Sun, places_are_read_and_checked) {
  const GeoPlace place = parse_geo_place("-33.8688,151.2093", "--place");
  EXPECT_EQ(place.latitude, -33.8688);
  EXPECT_EQ(place.longitude, 151.2093);
  EXPECT_EQ(decode_geo_place(encode_geo_place(place), "section"), place);
  for (const char* wrong : {"", "48", "48;11", "91,0", "0,181", "48,11,5", "nan,0"})
    EXPECT_THROW(parse_geo_place(wrong, "--place"), Error) << wrong;
  std::vector<std::byte> bytes = encode_geo_place(place);
  bytes.pop_back();
  EXPECT_THROW(decode_geo_place(bytes, "section"), Error);
}

}  // namespace
}  // namespace triptych
