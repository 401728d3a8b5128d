// What one of several files of a model adds, as one object.
#pragma once

#include "model/import/import.hpp"

#include <string>

namespace triptych {

/// Made before a file is imported: adds the object that stands for it (scene/file_objects.hpp).
class FileAsObject {
 public:
  FileAsObject(const std::string& name, Model& model);
  /// After the import: everything that the file added and that is in nothing, or belongs to no object, is in
  /// that object or belongs to it. `options`: those that its importer came to.
  void take_all(const ImportOptions& options);

 private:
  Model& model_;
  SourceObjectId object_ = no_id;
  size_t unit_property_;  ///< index into SourceObjects::properties
  size_t first_instance_, first_group_, first_group_instance_;
};

}  // namespace triptych
