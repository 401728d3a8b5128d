// .gltf and .glb: the importer tells them apart by their first bytes.
#include "fuzz_target.hpp"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  void (*import)(triptych::FileImport&) = triptych::import_gltf;
  triptych::fuzz::import_both_ways({data, size}, import);
  return 0;
}
