// Where the sun stands at a moment, seen from a place on Earth.
#pragma once

#include "scene/geo_place.hpp"
#include "scene/sky.hpp"

#include <string>

namespace triptych {

/// "2026-06-21T15:00Z", with seconds "…T15:00:30Z" or their fractions, or with the difference to UTC in place
/// of the Z, "…T17:00+02:00": seconds since the beginning of 1970, UTC. Years 1900 to 2100. Error (place) for
/// other text.
double parse_moment(const std::string& text, const std::string& place);

/// As parse_moment() reads it, to the millisecond.
std::string moment_text(double moment);

/// Degrees. Geometric: without refraction, which lifts the sun by 0.5 degrees at the horizon, and without
/// parallax (0.002 degrees).
struct SunPosition {
  double altitude;  ///< above the horizon
  double azimuth;   ///< from north over east
};

/// Meeus, Astronomical Algorithms (1998), chapters 12, 13 and 25 (low accuracy): within 0.01 degrees from
/// 1900 to 2100, as NOAA's solar calculator, which takes UT for dynamical time as well.
SunPosition sun_position(double latitude, double longitude, double moment);

/// The sky over a model at a moment.
Sky sky_over(const GeoPlace& geo_place, double moment);

}  // namespace triptych
