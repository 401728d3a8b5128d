#include "scene/section_text.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <vector>

namespace triptych {

namespace {

std::string_view trimmed(std::string_view words) {
  const size_t first = words.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return words.substr(first, words.find_last_not_of(' ') - first + 1);
}

std::optional<double> number(std::string_view words) {
  words = trimmed(words);
  double value = 0;
  const auto read = std::from_chars(words.data(), words.data() + words.size(), value);
  if (read.ec != std::errc() || read.ptr != words.data() + words.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// So many numbers with commas between them.
std::optional<std::vector<double>> numbers(std::string_view words, size_t count) {
  std::vector<double> values;
  for (size_t begin = 0; begin <= words.size();) {
    const size_t end = std::min(words.find(',', begin), words.size());
    const auto value = number(words.substr(begin, end - begin));
    if (!value) return std::nullopt;
    values.push_back(*value);
    begin = end + 1;
  }
  if (values.size() != count) return std::nullopt;
  return values;
}

/// "x<12.5".
std::optional<SectionPlane> along_axis(std::string_view words) {
  words = trimmed(words);
  const size_t axis = words.empty() ? std::string_view::npos : std::string_view("xyzXYZ").find(words.front());
  const std::string_view rest = trimmed(words.substr(words.empty() ? 0 : 1));
  if (axis == std::string_view::npos || rest.empty() || (rest.front() != '<' && rest.front() != '>'))
    return std::nullopt;
  const bool or_equal = rest.size() > 1 && rest[1] == '=';  // planes keep what lies in them anyhow
  const auto at = number(rest.substr(or_equal ? 2 : 1));
  if (!at) return std::nullopt;
  const double sign = rest.front() == '>' ? 1 : -1;
  glm::dvec3 normal(0);
  normal[static_cast<int>(axis % 3)] = sign;
  return SectionPlane{normal, sign * *at};
}

}  // namespace

SectionPlane read_section_plane(std::string_view words, const std::string& place) {
  if (const auto plane = along_axis(words)) return *plane;
  const auto read = numbers(words, 4);
  if (!read) {
    fail(place,
         "\"{}\" is no section plane: x<12.5 or z>3 says what is kept, or NX,NY,NZ,D its normal and "
         "offset",
         words);
  }
  const std::vector<double>& n = *read;
  return {{n[0], n[1], n[2]}, n[3]};
}

Box read_section_box(std::string_view words, const std::string& place) {
  const auto read = numbers(words, 6);
  if (!read) fail(place, "\"{}\" is no box: X0,Y0,Z0,X1,Y1,Z1 are its lowest corner and its highest", words);
  const std::vector<double>& n = *read;
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
}

std::string section_words(const SectionPlane& plane) {
  return fmt::format("{},{},{},{}", plane.normal.x, plane.normal.y, plane.normal.z, plane.offset);
}

std::string section_words(const Box& box) {
  return fmt::format("{},{},{},{},{},{}", box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z);
}

}  // namespace triptych
