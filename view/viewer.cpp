#include "view/viewer.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/notice.hpp"
#include "base/signals.hpp"
#include "render/png_file.hpp"
#include "scene/finest_boxes.hpp"
#include "view/keepsakes.hpp"
#include "view/viewpoint.hpp"

#include <algorithm>
#include <utility>

namespace triptych {

namespace {

Walker start(const Pack& pack, const ViewerOptions& options, double near) {
  Box box = model_box(pack.skeleton(), options.hiding.objects.get());
  if (box.empty()) box = model_box(pack.skeleton());
  if (options.path) return {options.path->view(0, 1, 1, near).camera, diagonal(box)};
  return Walker::before(box, near);
}

}  // namespace

std::string viewer_help() {
  return "  W A S D or arrows   forward, left, back, right     mouse, left button held   look around\n"
         "  E or space          up                             right button held         orbit what is under "
         "it\n"
         "  Q or left shift     down                           middle button held        pan\n"
         "  + -                 faster, slower (Ctrl + wheel)  wheel                     zoom to the cursor\n"
         "  F                   fit the selection, or all      left click                select: what is "
         "it?\n"
         "  1 3 7               from the front, right, top     5                         orthographic, "
         "perspective\n"
         "  Home, Backspace     the start, the place before    P                         play the path, "
         "stop\n"
         "  M, left clicks      measure; Backspace: a point    / or Ctrl+F               search: Enter, "
         "Shift+Enter\n"
         "                      back; Esc: all gone                                      go on, back; Esc "
         "ends it\n"
         "  C                   culling on, off                B                         bird's-eye view\n"
         "  [ ]                 finer, coarser                 L                         edges as lines, "
         "off\n"
         "  F2                  save the picture               F3                        save and print the "
         "camera\n"
         "  H I                 hide, isolate the selection    Ctrl, Alt, both with H I  its layer, storey, "
         "file\n"
         "  U                   show all                       Ctrl+Z                    as it was before\n"
         "  X                   cut at the surface under       Page Up, Page Down        move the cut on, "
         "back (Alt "
         "+ wheel)\n"
         "                      the cursor, six times at most  Z, Delete                 flip it, take it "
         "away\n"
         "  K                   cut to the box of the selection, or of all; and no longer\n"
         "  F4                  record the walk, stop          F5                        save a viewpoint "
         "(BCF)\n"
         "  Ctrl+C, Ctrl+V      copy the camera, take one\n"
         "  F1                  this help                      Esc                       nothing selected, "
         "leave\n";
}

Viewer::Viewer(const Pack& pack, ViewerOptions options)
    : pack_(pack),
      near_(pack.skeleton().default_near()),
      options_(std::move(options)),
      window_(options_.window),
      tour_(pack, start(pack, options_, near_)),
      inquiry_(pack, tour_),
      hider_(pack.skeleton(), options_.hiding),
      sections_(options_.section, pack.skeleton().diagonal()),
      place_(options_.place) {
  if (options_.path) exact_ = options_.path->frames.front();
  select_first(options_.selected);
  if (const auto place = place_.read()) begin_at(*place);
}

void Viewer::select_first(const std::vector<std::string>& guids) {
  if (guids.empty()) return;
  const auto objects = objects_of(tour_.selector().objects().source(), guids);
  if (!objects.empty()) tour_.select(tour_.selector().describe(objects.front()));
  if (objects.size() != 1 || guids.size() != 1)
    notice("of {} selected objects the model has {}; the first is selected", guids.size(), objects.size());
}

void Viewer::begin_at(const LastPlace& place) {
  const View view = Path{{place.camera}}.view(0, window_.width(), window_.height(), near_);
  tour_.begin_at(view.camera, place.pace);
  exact_ = place.camera;
  options_.pixel_error = place.pixel_error;
  options_.edges = place.edges;
  options_.culling = place.culling;
  options_.play = false;
  const PackObjects& objects = tour_.selector().objects();
  hider_.begin_at(triptych::hide(pack_.skeleton(), objects, place.hidden, options_.place.string()));
  sections_ = Sections(place.section, pack_.skeleton().diagonal());
  if (place.selected < tour_.selector().objects().source().objects.size())
    tour_.select(tour_.selector().describe(place.selected));
}

void Viewer::keep_place() {
  if (!place_.wanted() || !shown_) return;
  const auto& selection = tour_.selection();
  place_.keep({camera(), tour_.walker().pace(), options_.pixel_error, options_.edges, options_.culling,
               selection ? selection->object : no_id, sections_.section(),
               hiding().objects ? hiding().objects->objects() : ObjectSet()});
}

Viewer::~Viewer() {
  if (walk_ && !walk_->frames.empty()) save(Command::record_walk);
}

bool Viewer::plays() const {
  return options_.play && (options_.rate <= 0 || since_path_frame_.seconds() * options_.rate >= 1);
}

bool Viewer::wait_for_frame(double patience) {
  const Stopwatch waiting;
  do {
    const double left_s = patience - waiting.seconds();
    // Short, since a signal does not wake the window, and a path's next camera does not either.
    const double slice_s = options_.play ? 0.002 : 0.1;
    take(window_.poll(new_frame_ || plays() ? 0 : std::clamp(left_s, 0.0, slice_s)));
    left_ = left_ || stop_requested();
    keep_place();
    if (inquiry_.changed() && !new_frame_ && !plays()) show_again();
  } while (!new_frame_ && !plays() && !left_ && waiting.seconds() < patience);
  return (new_frame_ || plays()) && !left_;
}

void Viewer::take(Input input) {
  left_ = left_ || input.leave;
  const bool sought = inquiry_.take(input, window_.width(), window_.height());
  window_.read_text(inquiry_.reads_text());
  new_frame_ = new_frame_ || input.resized || input.damaged;
  for (const Command command : input.commands) take(command);
  cut(input);
  if (!tour_.take(input, window_.width(), window_.height()) && !sought) return;
  exact_.reset();
  options_.play = false;
  new_frame_ = true;
}

void Viewer::cut(const Input& input) {
  for (const Command command : input.commands) {
    if (!Sections::is_one(command)) continue;
    Sections::Scene scene{.eye = tour_.walker().eye(), .under_cursor = std::nullopt, .box = tour_.subject()};
    if (command == Command::begin_section) scene.under_cursor = tour_.under(input.cursor);
    if (const std::string words = sections_.take(command, scene); !words.empty()) saved_ = words;
  }
  if (input.section == 0) return;
  sections_.move(input.section, tour_.walker().eye());
  new_frame_ = true;
}

void Viewer::take(Command command) {
  new_frame_ = new_frame_ || (command != Command::help && command != Command::escape);
  switch (command) {
    case Command::escape:
      left_ = true;
      break;
    case Command::copy_camera:
      window_.set_clipboard(path_text({{camera()}}));
      saved_ = "camera copied";
      break;
    case Command::paste_camera:
      take_camera(window_.clipboard());
      break;
    case Command::toggle_culling:
      options_.culling = !options_.culling;
      break;
    case Command::toggle_birds_eye:
      birds_eye_wanted_ = !birds_eye_wanted_;
      break;
    case Command::toggle_play:
      options_.play = options_.path && !options_.play;
      if (!options_.path) saved_ = "there is no --path to play";
      break;
    case Command::toggle_edges:
      options_.edges = !options_.edges;
      break;
    case Command::take_picture:
      picture_wanted_ = true;
      break;
    case Command::save_viewpoint:
      viewpoint_wanted_ = true;
      break;
    case Command::save_camera:
    case Command::record_walk:
      save(command);
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
    default:  // the tour's, and those that hide
      if (Hider::takes(command)) hide(command);
      break;
  }
}

void Viewer::hide(Command command) {
  const auto& selection = tour_.selection();
  saved_ = hider_.take(command, tour_.selector().objects(), selection ? selection->object : no_id);
}

void Viewer::take_camera(const std::string& text) {
  try {
    const Path path = parse_path(text, "what was copied");
    tour_.jump_to(path.view(0, window_.width(), window_.height(), near_).camera);
    exact_ = path.frames.front();
    options_.play = false;
  } catch (const Error& error) {
    notice("no camera: {}", error.what());
    saved_ = "what was copied is no camera";
  }
}

PathFrame Viewer::camera() const { return exact_ ? *exact_ : path_frame(view().camera); }

void Viewer::save_viewpoint(const std::vector<uint8_t>& colors, const FrameState& frame) {
  saved_ = keep(options_.pictures, "viewpoint", "bcfzip", [&](const std::filesystem::path& file) {
    const Viewpoint viewpoint = viewpoint_of(camera(), frame, tour_.selector().objects().source(),
                                             tour_.selection(), options_.window.title);
    write_bcf(file, viewpoint, encode_png(window_.width(), window_.height(), colors, file.string()),
              time_text());
  });
}

void Viewer::say_alone(const std::string& reason) {
  if (alone_ == reason) return;
  alone_ = reason;
  if (shown_) set_title();
}

void Viewer::save(Command command) {
  Path path{{camera()}};
  if (command == Command::save_camera) {
    say(path_text(path));
  } else if (!walk_) {
    walk_ = Path{};
    saved_ = "recording the walk";
    return;
  } else {
    path = std::move(*walk_);
    walk_.reset();
  }
  const std::string kind = command == Command::save_camera ? "camera" : "walk";
  saved_ = keep(options_.pictures, kind, "json", [&](const std::filesystem::path& file) {
    if (path.frames.empty()) fail(file.string(), "nothing was drawn since the recording began");
    write_file(file, path_text(path));
  });
}

View Viewer::view() const {
  if (!exact_) return tour_.walker().view(window_.width(), window_.height());
  const Path path{{*exact_}};
  return path.view(0, window_.width(), window_.height(), near_);
}

FrameRequest Viewer::next_frame() {
  if (plays()) {
    since_path_frame_.restart();
    exact_ = options_.path->frames[path_frame_];
    path_frame_ = (path_frame_ + 1) % options_.path->frames.size();
    tour_.jump_to(view().camera);
  }
  new_frame_ = false;
  if (walk_) walk_->frames.push_back(camera());
  return {
      next_number_++,
      {view(), options_.pixel_error, options_.samples, options_.edges, sections_.section(), hider_.hiding()}};
}

void Viewer::show(const FrameRequest& frame, const FrameRecord& record, const FrameTarget& picture,
                  Device& device) {
  const FrameTarget* shown = &picture;
  if (birds_eye_wanted_) {
    if (!birds_eye_) birds_eye_.emplace(pack_.skeleton(), device);
    shown = &birds_eye_->draw(FrameView(pack_.skeleton(), frame.state), record.visible);
  }
  shown_ = shown;
  const std::vector<ScreenLine> lines =
      birds_eye_wanted_ ? std::vector<ScreenLine>() : inquiry_.lines(frame.state);
  const std::vector<uint8_t> colors = window_.show(*shown, picture_wanted_ || viewpoint_wanted_, lines);
  if (std::exchange(picture_wanted_, false)) {
    saved_ = keep(options_.pictures, "picture", "png", [&](const std::filesystem::path& file) {
      write_png(file, window_.width(), window_.height(), colors);
    });
  }
  if (std::exchange(viewpoint_wanted_, false)) save_viewpoint(colors, frame.state);
  tour_.saw(frame.state, record.visible);
  inquiry_.saw();
  // What was asked for may have been raised, to keep a target of time.
  const double pixel_error = frame.state.pixel_error;
  figures_ = fmt::format("{}: {:.0f} ms, {} of {} drawables, {} triangles, {:.3g} px", options_.window.title,
                         record.frame_ms, record.visible.size(), record.cut_drawables, record.drawn_triangles,
                         pixel_error);
  if (pixel_error > options_.pixel_error) figures_ += fmt::format(" (asked for {:g})", options_.pixel_error);
  set_title();
}

void Viewer::show_again() {
  const FrameState* frame = tour_.frame();
  if (!shown_ || !frame) return;
  const std::vector<ScreenLine> lines = inquiry_.lines(*frame);
  if (!birds_eye_wanted_) window_.show(*shown_, false, lines);
  set_title();
}

void Viewer::set_title() {
  std::string title = figures_;
  title +=
      fmt::format(", culling {}, {:.3g} units/s", options_.culling ? "on" : "off", tour_.walker().speed());
  if (const std::string cut = sections_.words(); !cut.empty()) title += ", " + cut;
  if (const auto& selection = tour_.selection()) title += ", " + selection->name;
  if (const uint32_t hidden = hiding().name.count; hidden > 0)
    title += fmt::format(", {} object{} hidden", hidden, hidden == 1 ? "" : "s");
  if (const std::string asked = inquiry_.title(); !asked.empty()) title += ", " + asked;
  if (!alone_.empty()) title += ", " + alone_;
  if (!saved_.empty()) title += ", " + std::exchange(saved_, {});
  window_.set_title(title);
}

}  // namespace triptych
