#include "model/import/mesh_stream_stl.hpp"

#include "model/import/mesh_stream_batch.hpp"

#include <cstring>

namespace triptych {

StlStream::StlStream(std::shared_ptr<const StreamSource> source, uint64_t facets,
                     std::vector<uint32_t> materials)
    : source_(std::move(source)), facets_(facets), materials_(std::move(materials)) {}

uint64_t StlStream::read(const TakeTriangles& take) const {
  TriangleBatch batch(take);
  SourceWindow window(source_, header_bytes, header_bytes + facets_ * facet_bytes);
  uint64_t attributes = 0;
  for (uint64_t i = 0; i < facets_; ++i) {
    const std::byte* bytes = window.take(facet_bytes);
    std::array<float, 9> values;  // they follow the normal
    std::memcpy(values.data(), bytes + 12, sizeof(values));
    uint16_t attribute = 0;
    std::memcpy(&attribute, bytes + 48, sizeof(attribute));
    batch.add({values[0], values[1], values[2]}, {values[3], values[4], values[5]},
              {values[6], values[7], values[8]}, materials_.empty() ? 0 : materials_[attribute]);
    attributes += materials_.empty() && attribute != 0;
  }
  const uint64_t dropped = batch.finish();
  dropped_ = dropped;
  attributes_ = attributes;
  return dropped;
}

std::vector<std::string> StlStream::warnings() const {
  return counted_warnings(source_->name(),
                          {{dropped_, not_finite_warning},
                           {attributes_, "facets with an attribute that is no colour, which was skipped"}});
}

}  // namespace triptych
