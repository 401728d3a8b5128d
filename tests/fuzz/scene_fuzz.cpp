// What a program that reads further formats writes: its libraries may be led astray by a file, and so may it.
#include "fuzz_target.hpp"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  triptych::fuzz::import_both_ways(
      {data, size}, [](triptych::FileImport& target) { triptych::import_scene(target, target.content()); });
  return 0;
}
