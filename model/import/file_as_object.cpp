#include "model/import/file_as_object.hpp"

#include "model/import/object_collector.hpp"
#include "scene/file_objects.hpp"

#include <array>

namespace triptych {

namespace {

/// Of a file that leaves it open; a format that defines the unit resets the option.
std::string unit_of(const ImportOptions& options) {
  static constexpr std::array<const char*, 5> names = {"metres", "centimetres", "millimetres", "inches",
                                                       "feet"};
  if (!options.unit) return "as the format says, or else metres";
  return std::string(names[static_cast<size_t>(*options.unit)]) + ", by --unit";
}

}  // namespace

FileAsObject::FileAsObject(const std::string& name, Model& model)
    : model_(model),
      unit_property_(model.source_objects.properties.size()),
      first_instance_(model.instances.size()),
      first_group_(model.groups.size()),
      first_group_instance_(model.group_instances.size()) {
  ObjectCollector objects(model.source_objects, name);
  const std::pair<std::string, std::string> unit{file_unit_name, ""};  // known after the import
  const uint32_t set = objects.add_set(file_set_name, std::span(&unit, 1));
  object_ = objects.add({.name = name, .type = file_object_type}, no_id, std::span(&set, 1));
}

void FileAsObject::take_all(const ImportOptions& options) {
  SourceObjects& source = model_.source_objects;
  for (SourceObjectId id = object_ + 1; id < source.objects.size(); ++id) {
    if (source.objects[id].parent == no_id) source.objects[id].parent = object_;
  }
  for (size_t i = first_instance_; i < model_.instances.size(); ++i) {
    if (model_.instances[i].object == no_id) model_.instances[i].object = object_;
  }
  for (size_t i = first_group_instance_; i < model_.group_instances.size(); ++i) {
    if (model_.group_instances[i].first_object == no_id) model_.group_instances[i].first_object = object_;
  }
  // In a group objects count from that of its placement, which is the file's where the file names nothing.
  for (size_t i = first_group_; i < model_.groups.size(); ++i) {
    for (Instance& instance : model_.groups[i].instances) {
      if (instance.object == no_id) instance.object = 0;
    }
    for (GroupInstance& inner : model_.groups[i].groups) {
      if (inner.first_object == no_id) inner.first_object = 0;
    }
  }
  source.properties[unit_property_].value = source.texts.add(unit_of(options));
}

}  // namespace triptych
