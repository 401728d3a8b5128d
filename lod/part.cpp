#include "lod/part.hpp"

#include "base/bytes.hpp"

namespace triptych {

SpoolPlace store(SpoolFile& file, const Part& part) {
  ByteWriter writer;
  writer.write(uint64_t{part.surface.points.size()});
  writer.write(uint64_t{part.surface.triangles.size()});
  writer.write(uint64_t{part.borders.size()});
  writer.write_all(std::span<const glm::ivec3>(part.surface.points));
  writer.write_all(std::span<const Triangle>(part.surface.triangles));
  writer.write_all(std::span<const BorderPoint>(part.borders));
  return file.append(writer.bytes());
}

Part load_part(const SpoolFile& file, const SpoolPlace& place) {
  const std::vector<std::byte> bytes = file.read(place);
  ByteReader reader(bytes, file.path().string());
  const auto points = reader.read<uint64_t>();
  const auto triangles = reader.read<uint64_t>();
  const auto borders = reader.read<uint64_t>();
  Part part;
  part.surface.points = reader.read_all<glm::ivec3>(points);
  part.surface.triangles = reader.read_all<Triangle>(triangles);
  part.borders = reader.read_all<BorderPoint>(borders);
  return part;
}

}  // namespace triptych
