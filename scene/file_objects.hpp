// The files of a model of several, as objects that hold all of what each added.
#pragma once

#include "scene/source_objects.hpp"

#include <string_view>
#include <vector>

namespace triptych {

/// SourceObject::type of an object that stands for a file. It is in nothing, and has the file's name.
inline constexpr std::string_view file_object_type = "model file";
/// Its set of properties, and in it the unit of the file's lengths.
inline constexpr std::string_view file_set_name = "File", file_unit_name = "Unit";

/// The objects that stand for files, ascending; none in a model of one file.
std::vector<SourceObjectId> file_objects(const SourceObjects& objects);
/// For each object which of them it is in, or is, as an index into that list; 0 where there are none.
std::vector<uint32_t> files_of_objects(const SourceObjects& objects);

}  // namespace triptych
