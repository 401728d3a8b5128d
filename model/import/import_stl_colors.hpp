// Colours of facets in binary STL, in the two dialects that exist.
#pragma once

#include "model/import/import_file.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace triptych {

/// The material of each of the 65,536 attributes that a facet may have, added to the target where facets use
/// it. Empty if the file has no colours. The dialect of Materialise Magics has "COLOR=" and four bytes in the
/// header, the colour of facets whose attribute has bit 15 set; others keep red in their lowest five bits. In
/// that of VisCAM and SolidView bit 15 says that there is a colour, with blue in the lowest bits.
/// Reads the facets once.
std::vector<uint32_t> stl_materials(const std::shared_ptr<const StreamSource>& source, uint64_t facets,
                                    std::span<const std::byte> header, FileImport& target);

}  // namespace triptych
