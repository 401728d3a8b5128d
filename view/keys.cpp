#include "view/keys.hpp"

#include <GLFW/glfw3.h>

namespace triptych {

namespace {

/// Ctrl, Alt or both, and H or I; shift goes down, and means nothing here.
std::optional<Command> hiding_command(bool isolates, int modifiers) {
  switch (modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT)) {
    case GLFW_MOD_CONTROL:
      return isolates ? Command::isolate_layer : Command::hide_layer;
    case GLFW_MOD_ALT:
      return isolates ? Command::isolate_storey : Command::hide_storey;
    case GLFW_MOD_CONTROL | GLFW_MOD_ALT:
      return isolates ? Command::isolate_file : Command::hide_file;
    default:
      return isolates ? Command::isolate_object : Command::hide_object;
  }
}

}  // namespace

std::optional<Command> command_of(int key, int modifiers) {
  switch (key) {
    case GLFW_KEY_H:
    case GLFW_KEY_I:
      return hiding_command(key == GLFW_KEY_I, modifiers);
    case GLFW_KEY_U:
      return Command::show_all;
    case GLFW_KEY_Z:
      return Command::flip_section;
    case GLFW_KEY_HOME:
      return Command::home;
    case GLFW_KEY_BACKSPACE:
      return Command::back;
    case GLFW_KEY_F:
      return Command::fit;
    case GLFW_KEY_1:
    case GLFW_KEY_KP_1:
      return Command::look_at_front;
    case GLFW_KEY_3:
    case GLFW_KEY_KP_3:
      return Command::look_at_right;
    case GLFW_KEY_7:
    case GLFW_KEY_KP_7:
      return Command::look_at_top;
    case GLFW_KEY_5:
    case GLFW_KEY_KP_5:
      return Command::switch_projection;
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_KP_ADD:
      return Command::faster;
    case GLFW_KEY_MINUS:
    case GLFW_KEY_KP_SUBTRACT:
      return Command::slower;
    case GLFW_KEY_F3:
      return Command::save_camera;
    case GLFW_KEY_F4:
      return Command::record_walk;
    case GLFW_KEY_C:
      return Command::toggle_culling;
    case GLFW_KEY_B:
      return Command::toggle_birds_eye;
    case GLFW_KEY_P:
      return Command::toggle_play;
    case GLFW_KEY_T:
      return Command::toggle_motion;
    case GLFW_KEY_L:
      return Command::toggle_edges;
    case GLFW_KEY_X:
      return Command::begin_section;
    case GLFW_KEY_DELETE:
      return Command::delete_section;
    case GLFW_KEY_PAGE_UP:
      return Command::push_section;
    case GLFW_KEY_PAGE_DOWN:
      return Command::pull_section;
    case GLFW_KEY_K:
      return Command::toggle_section_box;
    case GLFW_KEY_F2:
      return Command::take_picture;
    case GLFW_KEY_LEFT_BRACKET:
      return Command::finer;
    case GLFW_KEY_RIGHT_BRACKET:
      return Command::coarser;
    case GLFW_KEY_F1:
      return Command::help;
    case GLFW_KEY_F5:
      return Command::save_viewpoint;
    case GLFW_KEY_M:
      return Command::measure;
    case GLFW_KEY_ESCAPE:
      return Command::escape;
    default:
      return std::nullopt;
  }
}

std::optional<Command> control_command_of(int key, int modifiers) {
  switch (key) {
    case GLFW_KEY_Z:
      return (modifiers & GLFW_MOD_SHIFT) != 0 ? Command::redo : Command::undo;
    case GLFW_KEY_Y:
      return Command::redo;
    case GLFW_KEY_F:
      return Command::search;
    case GLFW_KEY_C:
      return Command::copy_camera;
    case GLFW_KEY_V:
      return Command::paste_camera;
    default:
      return std::nullopt;
  }
}

}  // namespace triptych
