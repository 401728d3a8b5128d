#include "scene/file_objects.hpp"

#include <algorithm>

namespace triptych {

std::vector<SourceObjectId> file_objects(const SourceObjects& objects) {
  std::vector<SourceObjectId> found;
  for (SourceObjectId id = 0; id < objects.objects.size(); ++id) {
    const SourceObject& object = objects.objects[id];
    if (object.parent == no_id && objects.texts[object.type] == file_object_type) found.push_back(id);
  }
  return found;
}

std::vector<uint32_t> files_of_objects(const SourceObjects& objects) {
  const std::vector<SourceObjectId> files = file_objects(objects);
  std::vector<uint32_t> file_of;  // parents come first
  for (SourceObjectId id = 0; id < objects.objects.size(); ++id) {
    const SourceObjectId parent = objects.objects[id].parent;
    const auto own = std::lower_bound(files.begin(), files.end(), id);
    if (parent != no_id) {
      file_of.push_back(file_of[parent]);
    } else {
      const bool is_file = own != files.end() && *own == id;
      file_of.push_back(is_file ? static_cast<uint32_t>(own - files.begin()) : 0);
    }
  }
  return file_of;
}

}  // namespace triptych
