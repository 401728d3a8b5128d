#include "fuzz_target.hpp"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  triptych::fuzz::import_both_ways({data, size}, triptych::import_3mf);
  return 0;
}
