// Which vector instructions the rasteriser uses.
#pragma once

#include "raster/simd/kernels.hpp"

#include <optional>
#include <string>
#include <vector>

namespace triptych {

/// In the order of their vectors' widths. `scalar`: none of them; the reference that the others agree with,
/// to the bit.
enum class InstructionSet { scalar, sse42, avx2, avx512 };

/// scalar, sse4.2, avx2, avx512.
const std::string& instruction_set_name(InstructionSet set);
/// Those that this processor has, `scalar` included.
const std::vector<InstructionSet>& instruction_sets_here();

/// What the rasteriser uses: the one that is forced, otherwise the last of instruction_sets_here().
InstructionSet instruction_set();
/// For all that is drawn in this process from now on; nothing: no longer. Precondition: the processor has it.
void force_instruction_set(std::optional<InstructionSet> set);
std::optional<InstructionSet> forced_instruction_set();

/// Of a set; null for `scalar`.
const RasterKernels* raster_kernels(InstructionSet set);

}  // namespace triptych
