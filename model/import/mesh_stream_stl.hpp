// The facets of a binary STL file as a stream.
#pragma once

#include "model/import/mesh_stream_source.hpp"
#include "model/mesh_stream.hpp"

#include <atomic>

namespace triptych {

class StlStream : public MeshStream {
 public:
  static constexpr uint64_t header_bytes = 84, facet_bytes = 50;

  /// `facets` of them begin behind the file's header. Error if they go beyond the file. `materials`: of each
  /// of the 65,536 attributes that a facet may have; empty: all have the default.
  StlStream(std::shared_ptr<const StreamSource> source, uint64_t facets, std::vector<uint32_t> materials);

  uint64_t triangle_count() const override { return facets_; }
  uint64_t read(const TakeTriangles& take) const override;
  std::vector<std::string> warnings() const override;

 private:
  std::shared_ptr<const StreamSource> source_;
  uint64_t facets_;
  std::vector<uint32_t> materials_;
  mutable std::atomic<uint64_t> dropped_{0}, attributes_{0};
};

}  // namespace triptych
