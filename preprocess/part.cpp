#include "preprocess/part.hpp"

namespace triptych {

void write_surface(ByteWriter& writer, const Surface& surface) {
  writer.write(uint64_t{surface.points.size()});
  writer.write_all(std::span<const glm::ivec3>(surface.points));
  writer.write(uint64_t{surface.triangles.size()});
  writer.write_all(std::span<const Triangle>(surface.triangles));
}

Surface read_surface(ByteReader& reader) {
  Surface surface;
  surface.points = reader.read_all<glm::ivec3>(reader.read<uint64_t>());
  surface.triangles = reader.read_all<Triangle>(reader.read<uint64_t>());
  return surface;
}

SpoolPlace store(SpoolFile& file, const Part& part) {
  ByteWriter writer;
  write_surface(writer, part.surface);
  writer.write_all(std::span<const BorderPoint>(part.borders));
  return file.append(writer.bytes());
}

Part load_part(const SpoolFile& file, const SpoolPlace& place) {
  const std::vector<std::byte> bytes = file.read(place);
  ByteReader reader(bytes, file.path().string());
  Part part;
  part.surface = read_surface(reader);
  part.borders = reader.read_all<BorderPoint>(reader.left() / sizeof(BorderPoint));
  return part;
}

std::vector<BorderPoint> load_borders(const SpoolFile& file, const SpoolPlace& place, uint32_t count) {
  const uint64_t size = uint64_t{count} * sizeof(BorderPoint);  // the last thing that store() writes
  const std::vector<std::byte> bytes = file.read({place.offset + place.size - size, size});
  return ByteReader(bytes, file.path().string()).read_all<BorderPoint>(count);
}

}  // namespace triptych
