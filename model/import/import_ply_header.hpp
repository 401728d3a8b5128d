// The header of a PLY file (Greg Turk's format): elements, their properties, and the encoding.
#pragma once

#include "model/import/import_reader.hpp"
#include "model/import/mesh_stream_positions.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

using PlyType = ScalarType;

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;    ///< of the value, or of a list's items
  std::optional<PlyType> count_type;  ///< of a list's length; an integer type
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The index of the property of one of these names, if there is one.
  std::optional<size_t> find(std::initializer_list<const char*> names) const;
  /// The length of a record in binary; nothing if it holds lists.
  std::optional<uint64_t> record_bytes() const;
};

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  uint64_t unknown_statements = 0;  ///< lines that were skipped
};

/// Reads up to "end_header". Error (line) for a header that is damaged or declares more data than the file
/// holds.
PlyHeader read_ply_header(ImportReader& reader);

}  // namespace triptych
