#include "measure/yardstick.hpp"

#include "base/clock.hpp"
#include "base/progress.hpp"
#include "model/read_mesh.hpp"

#include <limits>
#include <meshoptimizer.h>

namespace triptych {

namespace {

/// Collects corners of triangles; simplifies them when there are enough.
class Batch {
 public:
  void add(const CornerTriangle& triangle) {
    if (corners_.empty()) origin_ = triangle.corners[0];
    for (const glm::dvec3& corner : triangle.corners) corners_.emplace_back(corner - origin_);
  }
  size_t triangles() const { return corners_.size() / 3; }

  void simplify(Yardstick& yardstick) {
    if (corners_.empty()) return;
    const size_t corner_count = corners_.size();
    remap_.resize(corner_count);
    const size_t vertex_count = meshopt_generateVertexRemap(remap_.data(), nullptr, corner_count,
                                                            corners_.data(), corner_count, sizeof(glm::vec3));
    meshopt_remapVertexBuffer(corners_.data(), corners_.data(), corner_count, sizeof(glm::vec3),
                              remap_.data());
    simplified_.resize(corner_count);
    const Stopwatch stopwatch;
    const size_t left = meshopt_simplify(simplified_.data(), remap_.data(), corner_count, &corners_.front().x,
                                         vertex_count, sizeof(glm::vec3), corner_count / 6 * 3,
                                         std::numeric_limits<float>::max(), 0, nullptr);
    yardstick.seconds += stopwatch.seconds();
    yardstick.triangles += corner_count / 3;
    yardstick.left += left / 3;
    corners_.clear();
  }

 private:
  glm::dvec3 origin_{0};  ///< floats are differences from it: coordinates may be large
  std::vector<glm::vec3> corners_;
  std::vector<unsigned> remap_, simplified_;
};

}  // namespace

Yardstick measure_yardstick(const Model& model, size_t batch_triangles) {
  Yardstick yardstick;
  Batch batch;
  Progress progress("yardstick", model.source_triangles());
  for (const Mesh& mesh : model.meshes) {
    read_mesh(mesh, [&](std::span<const CornerTriangle> triangles) {
      for (const CornerTriangle& triangle : triangles) {
        batch.add(triangle);
        if (batch.triangles() >= batch_triangles) batch.simplify(yardstick);
      }
      progress.advance(triangles.size());
    });
    batch.simplify(yardstick);
  }
  return yardstick;
}

}  // namespace triptych
