#include "launch/pack_labels.hpp"

#include "base/error.hpp"
#include "base/shortest_names.hpp"
#include "launch/named_files.hpp"

namespace triptych {

std::vector<std::string> pack_labels(std::span<const std::filesystem::path> files) {
  for (size_t i = 0; i < files.size(); ++i) {
    for (size_t before = 0; before < i; ++before) {
      if (is_same_file(files[i], files[before]))
        fail(files[i].string(), "is the same pack as {}: each is measured once", files[before].string());
    }
  }
  return shortest_names(files);
}

}  // namespace triptych
