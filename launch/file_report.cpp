#include "launch/file_report.hpp"

#include "base/one_line.hpp"
#include "launch/text_table.hpp"
#include "measure/difference/object_shapes.hpp"
#include "scene/file_objects.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace triptych {

std::vector<FileShare> file_shares(const Pack& pack, const PackObjects& objects) {
  const SourceObjects& source = objects.source();
  std::vector<FileShare> files;
  for (const SourceObjectId id : file_objects(source))
    files.push_back({.object = id, .name = std::string(source.texts[source.objects[id].name]), .box = {}});
  if (files.empty()) return files;
  const std::vector<uint32_t> file_of = files_of_objects(source);
  const ObjectShapes shapes(pack, objects);
  for (SourceObjectId id = 0; id < source.objects.size(); ++id) {
    FileShare& file = files[file_of[id]];
    file.objects += id != file.object;
    file.triangles += shapes.triangles_of(id);
    file.box.extend(shapes.box_of(id));
  }
  return files;
}

nlohmann::json to_json(const std::vector<FileShare>& files) {
  nlohmann::json list = nlohmann::json::array();
  for (const FileShare& file : files) {
    const auto corner = [&](const glm::dvec3& at) {
      return file.box.empty() ? nlohmann::json() : nlohmann::json({at.x, at.y, at.z});
    };
    list.push_back({{"id", file.object},
                    {"name", file.name},
                    {"objects", file.objects},
                    {"placed_triangles", file.triangles},
                    {"box", {{"min", corner(file.box.lo)}, {"max", corner(file.box.hi)}}}});
  }
  return list;
}

std::string file_table(const std::vector<FileShare>& files) {
  std::vector<std::vector<std::string>> rows;
  for (const FileShare& file : files) {
    const glm::dvec3 size = file.box.empty() ? glm::dvec3(0) : file.box.hi - file.box.lo;
    rows.push_back({one_line(file.name), std::to_string(file.object),
                    in_threes(static_cast<double>(file.objects)),
                    in_threes(static_cast<double>(file.triangles)),
                    fmt::format("{:.6g} x {:.6g} x {:.6g}", size.x, size.y, size.z)});
  }
  return text_table({"file", "id", "objects", "placed triangles", "size"}, rows);
}

}  // namespace triptych
