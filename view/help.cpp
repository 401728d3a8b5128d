#include "view/help.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

namespace {

struct Row {
  const char *keys, *does, *more_keys, *more;
};
constexpr Row rows[] = {
    {"W A S D or arrows", "forward, left, back, right", "mouse, left button held", "look around"},
    {"E or space", "up", "right button held", "orbit what is under it"},
    {"Q or left shift", "down", "middle button held", "pan"},
    {"+ -", "faster, slower (Ctrl + wheel)", "wheel", "zoom to the cursor"},
    {"1 3 7", "from the front, right, top", "5", "orthographic, perspective"},
    {"Home, Backspace", "the start, the place before", "P", "play the path, stop"},
    {"T", "what moves: run, stand still", "", ""},
    {"", "", "", ""},
    {"left click", "select: what is it?", "Ctrl + click", "select more, or less"},
    {"/ or Ctrl+F", "search: a word", "Enter, Shift, Ctrl+Enter", "the next, the one before, all"},
    {"F", "fit the selection, or all", "Esc", "nothing selected; leave"},
    {"H I", "hide, isolate the selection", "Ctrl, Alt, both with H I", "its layer, storey, file"},
    {"U", "show all", "Ctrl+Z, Ctrl+Y", "undo, redo: hiding and cuts"},
    {"", "", "", ""},
    {"X", "cut at the surface under the", "Page Up, Page Down", "move the cut on, back (Alt + wheel)"},
    {"", "cursor, up to six times", "Z, Delete", "flip the cut, take it away"},
    {"K", "cut to a box of the selection,", "Page Up, Page Down", "without other cuts: the box smaller,"},
    {"", "or all; the same again: no box", "", "larger; Delete: no box"},
    {"M, left clicks", "measure; on the first: close", "Backspace", "a point back; Esc: all gone"},
    {"", "", "", ""},
    {"C", "culling on, off", "B", "bird's-eye view"},
    {"[ ]", "finer, coarser", "L", "edges as lines, off"},
    {"F2", "save the picture", "F3", "save and print the camera"},
    {"F4", "record the walk, stop", "F5", "save a viewpoint (BCF)"},
    {"Ctrl+C, Ctrl+V", "copy the camera, take one", "F1", "this help"},
};

std::string line_of(const Row& row) {
  std::string line = fmt::format("  {:<17} {:<31} {:<25} {}", row.keys, row.does, row.more_keys, row.more);
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace

std::string viewer_help() {
  std::string text;
  for (const Row& row : rows) {
    if (*row.does) text += line_of(row) + "\n";
  }
  return text;
}

std::vector<std::vector<Words>> help_pages(size_t columns, size_t lines) {
  std::vector<Words> wide, narrow;
  size_t widest = 0;
  for (const Row& row : rows) {
    wide.push_back({line_of(row)});
    widest = std::max(widest, wide.back().text.size());
  }
  if (widest <= columns && wide.size() <= lines) return {wide};
  const auto add = [&](const char* keys, const char* does) {
    if (*does) narrow.push_back({fmt::format("{:<25} {}", keys, does)});
  };
  for (const Row& row : rows) add(row.keys, row.does);
  for (const Row& row : rows) add(row.more_keys, row.more);
  const size_t on_a_page = std::max<size_t>(lines, 4) - 1,
               count = (narrow.size() + on_a_page - 1) / on_a_page;
  std::vector<std::vector<Words>> pages;
  for (size_t first = 0; first < narrow.size(); first += on_a_page) {
    const size_t end = std::min(first + on_a_page, narrow.size());
    std::vector<Words>& page = pages.emplace_back();
    for (size_t i = first; i < end; ++i) page.push_back(narrow[i]);
    const size_t number = pages.size();
    if (count > 1)
      page.push_back(
          {fmt::format("page {} of {}; F1: {}", number, count, number < count ? "the next" : "no help")});
  }
  return pages;
}

}  // namespace triptych
