#include "raster/instruction_set.hpp"

#include <array>
#include <atomic>

namespace triptych {

namespace {

bool is_here(InstructionSet set) {
  switch (set) {
    case InstructionSet::scalar:
      return true;
    case InstructionSet::sse42:
      return __builtin_cpu_supports("sse4.2") != 0;
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") != 0;
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0;
  }
  return false;
}

std::atomic<std::optional<InstructionSet>> forced;

}  // namespace

const std::string& instruction_set_name(InstructionSet set) {
  static const std::array<std::string, 4> names = {"scalar", "sse4.2", "avx2", "avx512"};
  return names[static_cast<size_t>(set)];
}

const std::vector<InstructionSet>& instruction_sets_here() {
  static const std::vector<InstructionSet> sets = [] {
    std::vector<InstructionSet> found;
    for (const InstructionSet set :
         {InstructionSet::scalar, InstructionSet::sse42, InstructionSet::avx2, InstructionSet::avx512}) {
      if (is_here(set)) found.push_back(set);
    }
    return found;
  }();
  return sets;
}

InstructionSet instruction_set() {
  const std::optional<InstructionSet> set = forced;
  return set ? *set : instruction_sets_here().back();
}

void force_instruction_set(std::optional<InstructionSet> set) { forced = set; }
std::optional<InstructionSet> forced_instruction_set() { return forced; }

const RasterKernels* raster_kernels(InstructionSet set) {
  switch (set) {
    case InstructionSet::scalar:
      break;
    case InstructionSet::sse42:
      return &sse42_kernels;
    case InstructionSet::avx2:
      return &avx2_kernels;
    case InstructionSet::avx512:
      return &avx512_kernels;
  }
  return nullptr;
}

}  // namespace triptych
