// Collects the triangles of a stream into batches, without those that cannot be used, and its warnings.
#pragma once

#include "model/import/import_limits.hpp"
#include "model/mesh_stream.hpp"

#include <fmt/core.h>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace triptych {

/// "<place>: <count> <what>" for each that was counted.
inline std::vector<std::string> counted_warnings(
    const std::string& place, std::initializer_list<std::pair<uint64_t, std::string_view>> counted) {
  std::vector<std::string> warnings;
  for (const auto& [count, what] : counted) {
    if (count > 0) warnings.push_back(fmt::format("{}: {} {}", place, count, what));
  }
  return warnings;
}

class TriangleBatch {
 public:
  explicit TriangleBatch(const TakeTriangles& take) : take_(take) { batch_.reserve(batch_triangles); }

  void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, uint32_t material,
           const CornerColors& colors = {}, const CornerNormals& normals = {},
           const CornerCoordinates& coordinates = {}) {
    if (!is_usable(a) || !is_usable(b) || !is_usable(c)) {
      ++dropped_;
      return;
    }
    batch_.push_back({{a, b, c}, material, colors, normals, coordinates});
    if (batch_.size() == batch_triangles) flush();
  }

  /// Hands out what is left; returns how many triangles were dropped in all.
  uint64_t finish() {
    if (!batch_.empty()) flush();
    return dropped_;
  }

 private:
  static constexpr size_t batch_triangles = 4096;
  void flush() {
    take_(batch_);
    batch_.clear();
  }
  const TakeTriangles& take_;
  std::vector<CornerTriangle> batch_;
  uint64_t dropped_ = 0;
};

}  // namespace triptych
