#include "view/viewer.hpp"

#include "base/clock.hpp"
#include "base/file.hpp"
#include "base/notice.hpp"
#include "base/signals.hpp"
#include "render/png_file.hpp"
#include "scene/finest_boxes.hpp"

#include <algorithm>

namespace triptych {

namespace {

Walker start(const Pack& pack, const ViewerOptions& options, double near) {
  const Box box = model_box(pack.skeleton());
  if (options.path) return {options.path->view(0, 1, 1, near).camera, diagonal(box)};
  return Walker::before(box, near);
}

}  // namespace

std::string viewer_help() {
  return "  W A S D or arrows   forward, left, back, right     mouse, left button held   look around\n"
         "  E or space          up                             wheel                     faster, slower\n"
         "  Q or left shift     down                           P                         play the path, "
         "stop\n"
         "  C                   culling on, off                B                         bird's-eye view\n"
         "  [ ]                 finer, coarser                 L                         edges as lines, "
         "off\n"
         "  H or F1             this help                      F2                        save the picture\n"
         "                                                     Esc                       leave\n";
}

Viewer::Viewer(const Pack& pack, ViewerOptions options)
    : pack_(pack),
      near_(pack.skeleton().default_near()),
      options_(std::move(options)),
      window_(options_.window),
      walker_(start(pack, options_, near_)) {
  if (options_.path) exact_ = options_.path->frames.front();
}

bool Viewer::wait_for_frame(double patience) {
  const Stopwatch waiting;
  do {
    const double left_s = patience - waiting.seconds();
    constexpr double slice_s = 0.1;  // short, since a signal does not wake the window
    take(window_.poll(new_frame_ || options_.play ? 0 : std::clamp(left_s, 0.0, slice_s)));
    left_ = left_ || stop_requested();
  } while (!new_frame_ && !options_.play && !left_ && waiting.seconds() < patience);
  return (new_frame_ || options_.play) && !left_;
}

void Viewer::take(const Input& input) {
  left_ = left_ || input.leave;
  new_frame_ = new_frame_ || input.resized || input.damaged;
  for (const Command command : input.commands) take(command);
  if (input.motion == Motion{}) return;
  walker_.move(input.motion, input.seconds, window_.height());
  exact_.reset();
  options_.play = false;
  new_frame_ = true;
}

void Viewer::take(Command command) {
  new_frame_ = new_frame_ || command != Command::help;
  switch (command) {
    case Command::toggle_culling:
      options_.culling = !options_.culling;
      break;
    case Command::toggle_birds_eye:
      birds_eye_wanted_ = !birds_eye_wanted_;
      break;
    case Command::toggle_play:
      options_.play = options_.path && !options_.play;
      break;
    case Command::toggle_edges:
      options_.edges = !options_.edges;
      break;
    case Command::take_picture:
      picture_wanted_ = true;
      break;
    case Command::finer:
      options_.pixel_error = std::max(options_.pixel_error / 2, 1.0 / 16);
      break;
    case Command::coarser:
      options_.pixel_error = std::min(options_.pixel_error * 2, 256.0);
      break;
    case Command::help:
      say(viewer_help());
      break;
  }
}

View Viewer::view() const {
  if (!exact_) return walker_.view(window_.width(), window_.height());
  const Path path{{*exact_}};
  return path.view(0, window_.width(), window_.height(), near_);
}

FrameRequest Viewer::next_frame() {
  if (options_.play) {
    exact_ = options_.path->frames[path_frame_];
    path_frame_ = (path_frame_ + 1) % options_.path->frames.size();
    walker_.jump_to(view().camera);
  }
  new_frame_ = false;
  return {next_number_++, {view(), options_.pixel_error, options_.samples, options_.edges}};
}

void Viewer::show(const FrameRequest& frame, const FrameRecord& record, const FrameTarget& picture,
                  Device& device) {
  const FrameTarget* shown = &picture;
  if (birds_eye_wanted_) {
    if (!birds_eye_) birds_eye_.emplace(pack_.skeleton(), device);
    shown = &birds_eye_->draw(FrameView(pack_.skeleton(), frame.state), record.visible);
  }
  const std::vector<uint8_t> colors = window_.show(*shown, picture_wanted_);
  const std::string saved = picture_wanted_ ? save(colors) : "";
  picture_wanted_ = false;
  // What was asked for may have been raised, to keep a target of time.
  const double pixel_error = frame.state.pixel_error;
  const std::string asked =
      pixel_error > options_.pixel_error ? fmt::format(" (asked for {:g})", options_.pixel_error) : "";
  window_.set_title(fmt::format("{}: {:.0f} ms, {} of {} drawables, {} triangles, {:.3g} px{}, culling {}{}",
                                options_.window.title, record.frame_ms, record.visible.size(),
                                record.cut_drawables, record.drawn_triangles, pixel_error, asked,
                                options_.culling ? "on" : "off", saved));
}

std::string Viewer::save(const std::vector<uint8_t>& colors) const {
  try {
    make_folder(options_.pictures);
    std::filesystem::path file;
    int number = 0;
    do {
      file = options_.pictures / fmt::format("picture-{:03}.png", number++);
    } while (std::filesystem::exists(file));
    write_png(file, window_.width(), window_.height(), colors);
    notice("wrote {}", file.string());
    return fmt::format(", saved {}", file.filename().string());
  } catch (const std::exception& error) {
    notice("the picture is not saved: {}", error.what());
    return ", picture NOT saved";
  }
}

}  // namespace triptych
