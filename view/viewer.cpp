#include "view/viewer.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/notice.hpp"
#include "base/signals.hpp"
#include "lod/sectioned.hpp"
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

Viewer::Viewer(const Pack& pack, ViewerOptions options)
    : pack_(pack),
      near_(pack.skeleton().default_near()),
      options_(std::move(options)),
      window_(options_.window),
      tour_(pack, start(pack, options_, near_)),
      inquiry_(pack, tour_),
      edits_(pack.skeleton(), options_.hiding, options_.section),
      hierarchy_(pack.skeleton()),
      clock_(options_.time),
      place_(options_.place) {
  if (options_.path) exact_ = options_.path->frames.front();
  if (exact_ && exact_->time_seconds) clock_.set(*exact_->time_seconds);
  select_first(options_.selected);
  if (const auto place = place_.read()) begin_at(*place);
}

void Viewer::select_first(const std::vector<std::string>& guids) {
  if (guids.empty()) return;
  const auto objects = objects_of(tour_.selector().objects().source(), guids);
  std::vector<Selection> selected;
  for (const SourceObjectId object : objects) selected.push_back(tour_.selector().describe(object));
  tour_.selected().set(std::move(selected));
  if (objects.size() < guids.size())
    notice("of {} selected objects the model has {}", guids.size(), objects.size());
}

void Viewer::select_again(const LastPlace& place, const View& view) {
  std::vector<Selection> selected;
  const size_t count = tour_.selector().objects().source().objects.size();
  for (const SourceObjectId object : place.selected) {
    if (object < count) selected.push_back(tour_.selector().describe(object));
  }
  for (const Picked& picked : place.picked) {
    const Skeleton& skeleton = pack_.skeleton();
    const bool is_there = picked.drawable < skeleton.drawables.size() &&
                          picked.placement < skeleton.drawables[picked.drawable].placement_count;
    if (is_there) selected.push_back(tour_.selector().describe(picked, {view, options_.pixel_error}));
  }
  tour_.selected().set(std::move(selected));
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
  edits_.begin_at(triptych::hide(pack_.skeleton(), objects, place.hidden, options_.place.string()),
                  place.section);
  select_again(place, view);
  inquiry_.measuring().go_on(place.measured);
}

void Viewer::keep_place() {
  if (!place_.wanted() || !shown_) return;
  LastPlace place{.camera = camera(),
                  .pace = tour_.walker().pace(),
                  .pixel_error = options_.pixel_error,
                  .edges = options_.edges,
                  .culling = options_.culling,
                  .selected = tour_.selected().objects(),
                  .section = edits_.section(),
                  .hidden = hiding().objects ? hiding().objects->objects() : ObjectSet(),
                  .measured = inquiry_.measuring().all()};
  for (const Selection& selection : tour_.selected().all()) {
    if (selection.object == no_id) place.picked.push_back(*selection.picked);
  }
  place_.keep(place);
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
    const double slice_s = options_.play || clock_.runs() ? 0.002 : 0.1;
    take(window_.poll(new_frame_ || goes_on() ? 0 : std::clamp(left_s, 0.0, slice_s)));
    left_ = left_ || stop_requested();
    keep_place();
    if (inquiry_.changed() && !new_frame_ && !goes_on()) show_again();
  } while (!new_frame_ && !goes_on() && !left_ && waiting.seconds() < patience);
  return (new_frame_ || goes_on()) && !left_;
}

void Viewer::take(Input input) {
  left_ = left_ || input.leave;
  const bool sought = inquiry_.take(input, window_.width(), window_.height());
  window_.read_text(inquiry_.reads_text());
  new_frame_ = new_frame_ || input.resized || input.damaged;
  for (const Command command : input.commands) {
    if (!Edits::takes(command)) {
      take(command);
    } else {
      said_ = edits_.take(command, tour_, input.cursor);
      new_frame_ = true;
    }
  }
  if (input.section != 0) {
    edits_.move(input.section, tour_.walker().eye());
    new_frame_ = true;
  }
  if (!tour_.take(input, window_.width(), window_.height()) && !sought) return;
  exact_.reset();
  options_.play = false;
  new_frame_ = true;
}

void Viewer::take(Command command) {
  new_frame_ = new_frame_ || command != Command::escape;
  switch (command) {
    case Command::escape:
      left_ = true;
      break;
    case Command::copy_camera:
      window_.set_clipboard(path_text({{camera()}}));
      said_ = "camera copied";
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
      if (!options_.path) said_ = "there is no --path to play";
      break;
    case Command::toggle_motion:
      if (pack_.skeleton().moving) clock_.toggle();
      if (!pack_.skeleton().moving) said_ = "nothing moves in this model";
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
    default:  // the tour's
      break;
  }
}

void Viewer::take_camera(const std::string& text) {
  try {
    const Path path = parse_path(text, "what was copied");
    tour_.jump_to(path.view(0, window_.width(), window_.height(), near_).camera);
    exact_ = path.frames.front();
    if (exact_->time_seconds) clock_.set(*exact_->time_seconds);
    options_.play = false;
  } catch (const Error& error) {
    notice("no camera: {}", error.what());
    said_ = "what was copied is no camera";
  }
}

PathFrame Viewer::camera() const {
  PathFrame camera = exact_ ? *exact_ : path_frame(view().camera);
  if (pack_.skeleton().moving) camera.time_seconds = clock_.seconds();
  return camera;
}

void Viewer::save_viewpoint(const std::vector<uint8_t>& colors, const FrameState& frame) {
  said_ = keep(options_.pictures, "viewpoint", "bcfzip", [&](const std::filesystem::path& file) {
    const Viewpoint viewpoint = viewpoint_of(camera(), frame, tour_.selector().objects().source(),
                                             tour_.selected(), options_.window.title);
    write_bcf(file, viewpoint, encode_png(window_.width(), window_.height(), colors, file.string()),
              time_text());
    const std::string lost = not_saved_text(frame, tour_.selector().objects().source(), tour_.selected());
    if (!lost.empty()) notice("{}: without {}", file.string(), lost);
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
    said_ = "recording the walk";
    return;
  } else {
    path = std::move(*walk_);
    walk_.reset();
  }
  const std::string kind = command == Command::save_camera ? "camera" : "walk";
  said_ = keep(options_.pictures, kind, "json", [&](const std::filesystem::path& file) {
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
    if (exact_->time_seconds) clock_.set(*exact_->time_seconds);
  }
  new_frame_ = false;
  since_frame_.restart();
  const double time = pack_.skeleton().moving ? clock_.seconds() : 0;
  if (walk_) {
    walk_->frames.push_back(camera());
    if (pack_.skeleton().moving) walk_->frames.back().time_seconds = time;
  }
  return {next_number_++,
          {view(), options_.pixel_error, options_.samples, options_.edges, edits_.section(), edits_.hiding(),
           options_.effects, time, options_.sky}};
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
      birds_eye_wanted_ ? std::vector<ScreenLine>() : inquiry_.lines(frame.state, window_.content_scale());
  const std::vector<uint8_t> colors = window_.show(*shown, picture_wanted_ || viewpoint_wanted_, lines);
  if (std::exchange(picture_wanted_, false)) {
    said_ = keep(options_.pictures, "picture", "png", [&](const std::filesystem::path& file) {
      write_png(file, window_.width(), window_.height(), colors);
    });
  }
  if (std::exchange(viewpoint_wanted_, false)) save_viewpoint(colors, frame.state);
  open_ = open_words(frame.state, record.visible);
  tour_.saw(frame.state, record.visible);
  inquiry_.saw();
  // What was asked for may have been raised, to keep a target of time.
  const double pixel_error = frame.state.pixel_error;
  figures_ = fmt::format(
      "{}: {:.0f} ms, {} of {} drawables, {} triangles, {} px", options_.window.title, record.frame_ms,
      record.visible.size(), record.cut_drawables, record.drawn_triangles,
      pixel_error < 1000 ? fmt::format("{:.3g}", pixel_error) : fmt::format("{:.0f}", pixel_error));
  if (pixel_error > options_.pixel_error) figures_ += fmt::format(" (asked for {:g})", options_.pixel_error);
  if (record.owed_drawables > 0) figures_ += fmt::format(", {} still coarser", record.owed_drawables);
  if (record.left_out_drawables > 0)
    figures_ += fmt::format(", NO ROOM for {} of them", record.left_out_drawables);
  new_frame_ = new_frame_ || record.gets_finer;
  set_title();
}

void Viewer::show_again() {
  const FrameState* frame = tour_.frame();
  if (!shown_ || !frame) return;
  const std::vector<ScreenLine> lines = inquiry_.lines(*frame, window_.content_scale());
  if (!birds_eye_wanted_) window_.show(*shown_, false, lines);
  set_title();
}

std::string Viewer::open_words(const FrameState& frame, const VisibleSet& visible) const {
  if (frame.section.keeps_all()) return {};
  const uint64_t open = count_sectioned(hierarchy_, FrameView(pack_.skeleton(), frame), visible).open;
  return open == 0 ? "" : fmt::format(" ({} cut {} open)", open, open == 1 ? "part is" : "parts are");
}

void Viewer::set_title() {
  std::string title = figures_;
  title +=
      fmt::format(", culling {}, {:.3g} units/s", options_.culling ? "on" : "off", tour_.walker().speed());
  if (pack_.skeleton().moving && tour_.frame())
    title += fmt::format(", time {:.1f} s{}", tour_.frame()->time, clock_.runs() ? "" : " (stands)");
  if (const std::string cut = edits_.words(); !cut.empty()) title += ", " + cut + open_;
  if (const std::string selected = tour_.selected().name(); !selected.empty()) title += ", " + selected;
  if (const uint32_t hidden = hiding().name.count; hidden > 0)
    title += fmt::format(", {} object{} hidden", hidden, hidden == 1 ? "" : "s");
  if (const std::string asked = inquiry_.title(); !asked.empty()) title += ", " + asked;
  if (!alone_.empty()) title += ", " + alone_;
  if (const std::string said = said_.now(); !said.empty()) title += ", " + said;
  window_.set_title(title);
}

}  // namespace triptych
