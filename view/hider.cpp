#include "view/hider.hpp"

#include "scene/file_objects.hpp"
#include "scene/object_words.hpp"

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <utility>
#include <vector>

namespace triptych {

namespace {

enum class Scope { object, layer, storey, file };

/// What a command does to which objects.
struct Meant {
  Command command;
  Scope scope;
  bool isolates;
};
constexpr std::array meant_by = {
    Meant{Command::hide_object, Scope::object, false}, Meant{Command::isolate_object, Scope::object, true},
    Meant{Command::hide_layer, Scope::layer, false},   Meant{Command::isolate_layer, Scope::layer, true},
    Meant{Command::hide_storey, Scope::storey, false}, Meant{Command::isolate_storey, Scope::storey, true},
    Meant{Command::hide_file, Scope::file, false},     Meant{Command::isolate_file, Scope::file, true}};

const Meant* find(Command command) {
  const auto* const found = std::find_if(meant_by.begin(), meant_by.end(),
                                         [&](const Meant& meant) { return meant.command == command; });
  return found == meant_by.end() ? nullptr : found;
}

/// The text of the object, or of the nearest one that it is in and that has one.
std::string text_of(const SourceObjects& source, SourceObjectId object, uint32_t SourceObject::*text) {
  for (; object != no_id; object = source.objects[object].parent) {
    if (const uint32_t own = source.objects[object].*text; own != 0) return std::string(source.texts[own]);
  }
  return {};
}

/// All objects of the scope that this one is in; none where it has no layer, no storey, no file.
std::vector<SourceObjectId> objects_of(const SourceObjects& source, SourceObjectId object, Scope scope) {
  if (scope == Scope::object) return {object};
  if (scope == Scope::file) {
    const std::vector<SourceObjectId> files = file_objects(source);
    if (files.empty()) return {};
    return {files[files_of_objects(source)[object]]};
  }
  const bool layer = scope == Scope::layer;
  const std::string name = text_of(source, object, layer ? &SourceObject::layer : &SourceObject::storey);
  if (name.empty()) return {};
  return ObjectFinder(source).find((layer ? "layer:" : "storey:") + name);
}

const char* what(Scope scope) {
  switch (scope) {
    case Scope::layer:
      return "nothing says which layer it is on";
    case Scope::storey:
      return "nothing says in which storey it is";
    case Scope::file:
      return "the model is of one file";
    case Scope::object:
      break;
  }
  return "";
}

}  // namespace

bool Hider::takes(Command command) { return find(command) != nullptr || command == Command::show_all; }

std::string Hider::take(Command command, const PackObjects& objects,
                        std::span<const SourceObjectId> selected) {
  if (command == Command::show_all) {
    hiding_ = {};
    return {};
  }
  const Meant& meant = *find(command);
  if (selected.empty()) return "no object is selected: click on one";
  const SourceObjects& source = objects.source();
  std::vector<SourceObjectId> alike;
  for (const SourceObjectId object : selected) {
    const std::vector<SourceObjectId> more = objects_of(source, object, meant.scope);
    alike.insert(alike.end(), more.begin(), more.end());
  }
  if (alike.empty()) return what(meant.scope);
  ObjectSet set = with_contents(source, alike);
  if (meant.isolates) {
    set = all_but(source, set);
  } else if (hiding_.objects) {
    set = united(hiding_.objects->objects(), set);
  }
  hiding_ = hide(skeleton_, objects, std::move(set), "view");
  return {};
}

}  // namespace triptych
