#include "model/import/import_stl_colors.hpp"

#include "model/import/display_color.hpp"
#include "model/import/mesh_stream_stl.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string_view>

namespace triptych {

namespace {

constexpr size_t attribute_count = size_t{1} << 16;
constexpr uint32_t flag = 0x8000;

/// The colour behind "COLOR=" in the header, if there is one.
std::optional<glm::vec4> object_color(std::span<const std::byte> header) {
  const std::string_view text(reinterpret_cast<const char*>(header.data()), header.size());
  const size_t at = text.find("COLOR=");
  if (at == std::string_view::npos || at + 10 > std::min<size_t>(text.size(), 80)) return std::nullopt;
  const auto channel = [&](size_t i) { return std::to_integer<int>(header[at + 6 + i]) / 255.0; };
  return from_display_color(channel(0), channel(1), channel(2));
}

/// Which attributes facets have.
std::vector<bool> used_attributes(const std::shared_ptr<const StreamSource>& source, uint64_t facets) {
  std::vector<bool> used(attribute_count);
  const uint64_t begin = StlStream::header_bytes;
  SourceWindow window(source, begin, begin + facets * StlStream::facet_bytes);
  for (uint64_t i = 0; i < facets; ++i) {
    uint16_t attribute = 0;
    std::memcpy(&attribute, window.take(StlStream::facet_bytes) + 48, sizeof(attribute));
    used[attribute] = true;
  }
  return used;
}

glm::vec4 color_of(uint32_t attribute, bool red_first) {
  const auto channel = [&](uint32_t shift) { return (attribute >> shift & 31) / 31.0; };
  return from_display_color(channel(red_first ? 0 : 10), channel(5), channel(red_first ? 10 : 0));
}

}  // namespace

std::vector<uint32_t> stl_materials(const std::shared_ptr<const StreamSource>& source, uint64_t facets,
                                    std::span<const std::byte> header, FileImport& target) {
  const auto object = object_color(header);
  const std::vector<bool> used = used_attributes(source, facets);
  const bool flagged = std::any_of(used.begin() + flag, used.end(), [](bool is_used) { return is_used; });
  if (!object && !flagged) return {};
  std::vector<uint32_t> materials(attribute_count, 0);
  std::optional<uint32_t> of_object;
  for (uint32_t attribute = 0; attribute < attribute_count; ++attribute) {
    if (!used[attribute]) continue;
    const bool has_flag = (attribute & flag) != 0;
    if (object && has_flag) {
      if (!of_object) of_object = target.add_material({*object});
      materials[attribute] = *of_object;
    } else if (object || has_flag) {
      materials[attribute] = target.add_material({color_of(attribute, object.has_value())});
    }
  }
  return materials;
}

}  // namespace triptych
