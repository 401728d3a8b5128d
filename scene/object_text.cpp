#include "scene/object_text.hpp"

#include "base/one_line.hpp"

#include <fmt/core.h>
#include <span>

namespace triptych {

std::string in_one_cell(std::string_view text, size_t most) {
  if (text.size() > most) {
    size_t end = most - 3;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
    return one_line(std::string(text.substr(0, end))) + "...";
  }
  return one_line(std::string(text));
}

std::string object_text(const PackObjects& objects, SourceObjectId id) {
  constexpr size_t most_properties = 20, longest = 120;
  const SourceObjects& source = objects.source();
  const SourceObject& object = source.objects[id];
  const auto text_of = [&](uint32_t text) { return in_one_cell(source.texts[text], longest); };
  std::string text = fmt::format("  object {}: {}", id, object.name == 0 ? "no name" : text_of(object.name));
  for (const ObjectText& member : std::span(object_texts).subspan(1)) {
    if (object.*member.text != 0) text += fmt::format(", {} {}", member.name, text_of(object.*member.text));
  }
  text += "\n";
  if (const std::string path = source.path_of(id); !path.empty())
    text += fmt::format("    in {}\n", in_one_cell(path, longest));
  size_t left_out = 0, printed = 0;
  for (const uint32_t set : source.sets_of(id)) {
    for (const SourceProperty& property : source.properties_of(set)) {
      if (++printed > most_properties) {
        ++left_out;
        continue;
      }
      text += fmt::format("    {}: {} = {}\n", text_of(source.sets[set].name), text_of(property.name),
                          text_of(property.value));
    }
  }
  if (left_out > 0) text += fmt::format("    and {} more properties\n", left_out);
  return text;
}

}  // namespace triptych
