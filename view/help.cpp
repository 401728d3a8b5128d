#include "view/help.hpp"

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

std::vector<Words> help_words() {
  std::vector<Words> words;
  for (const Row& row : rows) words.push_back({line_of(row)});
  return words;
}

}  // namespace triptych
