// The files of a model of several: what of it is whose.
#pragma once

#include "scene/pack.hpp"
#include "scene/pack_objects.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace triptych {

struct FileShare {
  SourceObjectId object = no_id;  ///< that stands for the file
  std::string name;
  uint64_t objects = 0;    ///< in it, at any depth
  uint64_t triangles = 0;  ///< placed, at full detail
  Box box;                 ///< of these, model units
};

/// Empty for a model of one file.
std::vector<FileShare> file_shares(const Pack& pack, const PackObjects& objects);

nlohmann::json to_json(const std::vector<FileShare>& files);
std::string file_table(const std::vector<FileShare>& files);

}  // namespace triptych
