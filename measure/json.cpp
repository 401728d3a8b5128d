#include "measure/json.hpp"

#include "base/file.hpp"

namespace triptych {

nlohmann::json to_json(const Distribution& distribution) {
  return {{"mean", distribution.mean},
          {"p50", distribution.p50},
          {"p95", distribution.p95},
          {"p99", distribution.p99},
          {"max", distribution.max}};
}

void write_json(const std::filesystem::path& file, const nlohmann::json& object) {
  if (!file.empty()) write_file(file, object.dump(2) + "\n");
}

}  // namespace triptych
