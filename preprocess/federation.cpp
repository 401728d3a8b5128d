#include "preprocess/federation.hpp"

#include "preprocess/strays.hpp"
#include "scene/file_objects.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace triptych {

namespace {

/// Diagonals of the larger of two files: what is further apart has hardly one origin.
constexpr double far = 10;
/// Metres and millimetres differ by 1000, the files of one site by less than this.
constexpr double far_larger = 500;

struct File {
  std::string name, unit;
  Box box;  ///< of what it places, model units
};

std::vector<File> files_of(const Model& model, const BuildPlan& plan) {
  const SourceObjects& source = model.source_objects;
  std::vector<File> files;
  for (const SourceObjectId id : file_objects(source)) {
    File& file = files.emplace_back();
    file.name = source.texts[source.objects[id].name];
    for (const uint32_t set : source.sets_of(id)) {
      for (const SourceProperty& property : source.properties_of(set)) {
        if (source.texts[property.name] == file_unit_name) file.unit = source.texts[property.value];
      }
    }
  }
  if (files.size() < 2) return {};
  const std::vector<uint32_t> file_of = files_of_objects(source);
  const auto whole = static_cast<uint32_t>(plan.hierarchies.size() - 1);
  const PlannedHierarchy& hierarchy = plan.hierarchies[whole];
  const auto extend = [&](SourceObjectId object, uint32_t transform, const Box& box) {
    if (object != no_id && !box.empty())
      files[file_of[object]].box.extend(placed_box(hierarchy.transforms[transform], box));
  };
  for (size_t i = 0; i < plan.instances.size(); ++i) {
    const PlannedInstance& instance = plan.instances[i];
    if (instance.hierarchy == whole)
      extend(plan.objects[i], instance.transform, plan.meshes[instance.mesh].box);
  }
  for (const PlannedSubHierarchy& inner : hierarchy.sub_hierarchies)
    extend(inner.first_object, inner.transform, plan.hierarchies[inner.hierarchy].box);
  return files;
}

std::string described(const File& file) {
  return fmt::format("\"{}\" ({}; {:.6g} m large)", file.name, file.unit, diagonal(file.box));
}

}  // namespace

std::vector<std::string> federation_warnings(const Model& model, const BuildPlan& plan) {
  std::vector<std::string> warnings;
  const std::vector<File> files = files_of(model, plan);
  for (size_t i = 1; i < files.size(); ++i) {
    if (files[i].box.empty()) continue;
    size_t nearest = files.size();  // of the files before: each pair is said once
    for (size_t other = 0; other < i; ++other) {
      if (files[other].box.empty()) continue;
      if (nearest == files.size() ||
          distance_of(files[i].box, files[other].box) < distance_of(files[i].box, files[nearest].box))
        nearest = other;
    }
    if (nearest == files.size()) continue;
    const double distance = distance_of(files[i].box, files[nearest].box);
    const auto [smaller, larger] = std::minmax({diagonal(files[i].box), diagonal(files[nearest].box)});
    const bool apart = distance > far * larger, unlike = smaller > 0 && larger > far_larger * smaller;
    if (!apart && !unlike) continue;
    warnings.push_back(fmt::format(
        "{} and {} are {:.6g} m apart{}: they may have {}", described(files[nearest]), described(files[i]),
        distance,
        unlike ? fmt::format(", and one is {:.3g} times as large as the other", larger / smaller) : "",
        unlike ? "other units, which --unit or the program that wrote them can mend"
               : "other origins, which the program that wrote them can mend"));
  }
  return warnings;
}

}  // namespace triptych
