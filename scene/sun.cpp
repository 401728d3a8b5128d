#include "scene/sun.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string_view>

namespace triptych {

namespace {

constexpr double degree = std::numbers::pi / 180, day_seconds = 86400;

/// Takes numbers and signs off the front of a text.
class MomentReader {
 public:
  explicit MomentReader(std::string_view text) : left_(text) {}
  /// Of so many digits; less than 0, and is_good() is false, where they are not there.
  int number(size_t digits) {
    int value = -1;
    const auto word = left_.substr(0, digits);
    const auto end = word.data() + word.size();
    const auto parsed = std::from_chars(word.data(), end, value);
    good_ = good_ && word.size() == digits && parsed.ec == std::errc() && parsed.ptr == end && value >= 0;
    left_.remove_prefix(word.size());
    return value;
  }
  bool takes(char sign) {
    if (!left_.starts_with(sign)) return false;
    left_.remove_prefix(1);
    return true;
  }
  void expect(char sign) { good_ = takes(sign) && good_; }
  /// Digits behind a point.
  double fraction() {
    double value = 0, unit = 0.1;
    bool any = false;
    for (; !left_.empty() && left_[0] >= '0' && left_[0] <= '9'; left_.remove_prefix(1), unit /= 10) {
      value += unit * (left_[0] - '0');
      any = true;
    }
    good_ = good_ && any;
    return value;
  }
  bool is_good() const { return good_; }
  bool ends() const { return left_.empty(); }

 private:
  std::string_view left_;
  bool good_ = true;
};

double within_turn(double degrees) { return degrees - 360 * std::floor(degrees / 360); }

}  // namespace

double parse_moment(const std::string& text, const std::string& place) {
  MomentReader reader(text);
  const int year = reader.number(4);
  reader.expect('-');
  const int month = reader.number(2);
  reader.expect('-');
  const int day = reader.number(2);
  reader.expect('T');
  const int hour = reader.number(2);
  reader.expect(':');
  const int minute = reader.number(2);
  double seconds = 0;
  if (reader.takes(':')) {
    seconds = reader.number(2);
    if (reader.takes('.')) seconds += reader.fraction();
  }
  double east_minutes = 0;
  if (!reader.takes('Z')) {
    const double sign = reader.takes('-') ? -1 : 1;
    if (sign > 0) reader.expect('+');
    const int hours = reader.number(2);
    reader.expect(':');
    const int minutes = reader.number(2);
    if (hours > 14 || minutes > 59) reader.expect('\0');
    east_minutes = sign * (hours * 60 + minutes);
  }
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!reader.is_good() || !reader.ends() || !date.ok() || hour > 23 || minute > 59 || !(seconds < 60))
    fail(place, "\"{}\" is no moment as 2026-06-21T15:00Z, or 2026-06-21T17:00+02:00", text);
  if (year < 1900 || year > 2100) fail(place, "\"{}\" is not from 1900 to 2100", text);
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return static_cast<double>(days) * day_seconds + hour * 3600 + (minute - east_minutes) * 60 + seconds;
}

std::string moment_text(double moment) {
  const double whole_days = std::floor(moment / day_seconds);
  const std::chrono::year_month_day date{
      std::chrono::sys_days(std::chrono::days(static_cast<int>(whole_days)))};
  const auto milliseconds = static_cast<int>(std::floor((moment - whole_days * day_seconds) * 1000 + 0.5));
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     milliseconds / 3600000, milliseconds / 60000 % 60, milliseconds / 1000 % 60,
                     milliseconds % 1000);
}

SunPosition sun_position(double latitude, double longitude, double moment) {
  constexpr double unix_epoch = 2440587.5, j2000 = 2451545;  // Julian days
  const double days = unix_epoch + moment / day_seconds - j2000, t = days / 36525;
  // The sun's apparent longitude (25.2 to 25.4).
  const double mean = 280.46646 + t * (36000.76983 + t * 0.0003032);
  const double anomaly = (357.52911 + t * (35999.05029 - t * 0.0001537)) * degree;
  const double center = (1.914602 - t * (0.004817 + t * 0.000014)) * std::sin(anomaly) +
                        (0.019993 - t * 0.000101) * std::sin(2 * anomaly) + 0.000289 * std::sin(3 * anomaly);
  const double node = (125.04 - 1934.136 * t) * degree;
  const double apparent = (mean + center - 0.00569 - 0.00478 * std::sin(node)) * degree;
  const double obliquity =
      (23.0 + (26.0 + (21.448 - t * (46.8150 + t * (0.00059 - t * 0.001813))) / 60) / 60 +
       0.00256 * std::cos(node)) *
      degree;
  // As right ascension and declination (25.6, 25.7), and the sidereal time at Greenwich (12.4).
  const double ascension = std::atan2(std::cos(obliquity) * std::sin(apparent), std::cos(apparent));
  const double declination = std::asin(std::sin(obliquity) * std::sin(apparent));
  const double sidereal = 280.46061837 + 360.98564736629 * days + t * t * (0.000387933 - t / 38710000);
  // The local hour angle, and from it the horizontal coordinates (13.5, 13.6).
  const double hour_angle = within_turn(sidereal + longitude) * degree - ascension;
  const double phi = latitude * degree;
  const double south = std::cos(hour_angle) * std::cos(declination) * std::sin(phi) -
                       std::sin(declination) * std::cos(phi),
               west = std::sin(hour_angle) * std::cos(declination),
               up = std::sin(phi) * std::sin(declination) +
                    std::cos(phi) * std::cos(declination) * std::cos(hour_angle);
  return {std::asin(std::clamp(up, -1.0, 1.0)) / degree, within_turn(std::atan2(west, south) / degree + 180)};
}

Sky sky_over(const GeoPlace& geo_place, double moment) {
  const SunPosition sun = sun_position(geo_place.latitude, geo_place.longitude, moment);
  const double level = std::cos(sun.altitude * degree);
  const double north = level * std::cos(sun.azimuth * degree), east = level * std::sin(sun.azimuth * degree);
  // Seen from above, with y up, x to the right and z down, east lies a quarter turn clockwise of north.
  const glm::dvec2 to_north = geo_place.north, to_east(-to_north.y, to_north.x);
  return {true,
          {north * to_north.x + east * to_east.x, std::sin(sun.altitude * degree),
           north * to_north.y + east * to_east.y}};
}

}  // namespace triptych
