#include "base/error.hpp"
#include "base/progress.hpp"
#include "launch/command.hpp"
#include "launch/number_flags.hpp"
#include "launch/object_report.hpp"
#include "launch/text_table.hpp"
#include "measure/explanation.hpp"
#include "measure/json.hpp"
#include "measure/pixel_rays.hpp"
#include "scene/object_text.hpp"
#include "session/open_pack.hpp"

#include <cmath>
#include <fmt/core.h>

namespace triptych {

namespace {

struct ExplainCommand {
  RunOptions run;
  ShownModel model;
  uint32_t frame = 0;
  std::vector<int> pixel;  ///< x, y; empty: none was given
  std::optional<DrawableId> drawable;
};

std::string pixels_text(double pixels) {
  return std::isfinite(pixels) ? fmt::format("{:.3g} px", pixels) : "unbounded px, as the eye is so near";
}

std::string name_of(const DrawableFacts& facts) {
  return fmt::format("drawable {} (scene node {}, level {} of {}, {})", facts.id, facts.scene_node,
                     facts.level, facts.levels, pixels_text(facts.pixels));
}

const std::string& name_of(Fate fate) {
  static const std::vector<std::string> names = {"drawn",          "coarser", "finer",   "outside_frustum",
                                                 "between_pixels", "hidden",  "withheld"};
  return names[static_cast<size_t>(fate)];
}

/// Why cut selection chose it.
std::string selection_text(const DrawableExplanation& explanation, double pixel_error) {
  const DrawableFacts& facts = explanation.facts;
  std::string text;
  if (explanation.finest_there_is && pixel_error > 0) {
    text = fmt::format("there is no finer one, although it may be off by {}", pixels_text(facts.pixels));
  } else if (pixel_error > 0) {
    text = fmt::format("its {} keep the pixel error of {:g}", pixels_text(facts.pixels), pixel_error);
  } else {
    text = "full detail was asked for";
  }
  if (explanation.coarser) {
    text += fmt::format("; the next coarser, {}, does not", name_of(*explanation.coarser));
  } else {
    text += "; nothing is coarser";
  }
  return text;
}

/// One line for each of the first few drawables that decided.
std::string by_text(const DrawableExplanation& explanation, const char* unit) {
  constexpr size_t shown = 5;
  std::string text;
  for (size_t i = 0; i < std::min(shown, explanation.by.size()); ++i) {
    text += "    " + name_of(explanation.by[i]);
    if (i < explanation.by_pixels.size()) {
      text += fmt::format(", {} {}", in_threes(static_cast<double>(explanation.by_pixels[i])), unit);
    }
    text += "\n";
  }
  if (explanation.by.size() > shown) text += fmt::format("    and {} more\n", explanation.by.size() - shown);
  return text;
}

std::string fate_text(const DrawableExplanation& explanation, double pixel_error) {
  const DrawableFacts& facts = explanation.facts;
  const std::string at = explanation.decided_at == facts.scene_node
                             ? "its box"
                             : fmt::format("the box of scene node {} above it", explanation.decided_at);
  switch (explanation.fate) {
    case Fate::drawn:
      return fmt::format("  drawn: {}\n", selection_text(explanation, pixel_error));
    case Fate::coarser:
      return fmt::format(
          "  not in the cut: a coarser one keeps the pixel error of {:g} and stands for it\n{}", pixel_error,
          by_text(explanation, "pixels"));
    case Fate::finer:
      return fmt::format("  not in the cut: it may be off by {}, the pixel error is {:g}; {} for it\n{}",
                         pixels_text(facts.pixels), pixel_error,
                         explanation.by.size() == 1 ? "a finer one stands" : "finer ones stand",
                         by_text(explanation, "pixels"));
    case Fate::outside_frustum:
      return fmt::format("  not in the cut: {} lies outside the frustum\n", at);
    case Fate::between_pixels:
      return fmt::format("  in the cut, not drawn: {} covers no pixel's centre\n", at);
    case Fate::hidden:
      return fmt::format(
          "  in the cut ({}), not drawn: the occlusion test found {} hidden; in front of it are\n{}",
          selection_text(explanation, pixel_error), at, by_text(explanation, "pixels there"));
    case Fate::withheld:
      break;
  }
  return "  in the cut, and nothing hides it, but it was withheld: this is a fault in culling\n";
}

nlohmann::json to_json(const DrawableFacts& facts) {
  return {{"drawable", facts.id},       {"scene_node", facts.scene_node}, {"depth", facts.depth},
          {"level", facts.level},       {"levels", facts.levels},         {"triangles", facts.triangles},
          {"bound_units", facts.error}, {"bound_pixels", facts.pixels}};
}

nlohmann::json to_json(const DrawableExplanation& explanation) {
  nlohmann::json json = to_json(explanation.facts);
  json["fate"] = name_of(explanation.fate);
  json["pixels_owned"] = explanation.pixels_owned;
  if (explanation.coarser) json["coarser"] = to_json(*explanation.coarser);
  if (explanation.decided_at != no_id) json["decided_at_scene_node"] = explanation.decided_at;
  for (size_t i = 0; i < explanation.by.size(); ++i) {
    nlohmann::json by = to_json(explanation.by[i]);
    if (i < explanation.by_pixels.size()) by["pixels_owned"] = explanation.by_pixels[i];
    json["by"].push_back(by);
  }
  return json;
}

void print(const DrawableExplanation& explanation, double pixel_error) {
  const DrawableFacts& facts = explanation.facts;
  fmt::print("drawable {}: scene node {} at depth {}, level {} of {} (0 is the finest), {} triangles\n",
             facts.id, facts.scene_node, facts.depth, facts.level, facts.levels, in_threes(facts.triangles));
  fmt::print("  bound: {:.4g} model units, {}; owns {} pixels\n", facts.error, pixels_text(facts.pixels),
             in_threes(static_cast<double>(explanation.pixels_owned)));
  fmt::print("{}", fate_text(explanation, pixel_error));
}

/// Prints and reports the objects that a drawable shows: the one at the pixel, where there is a pixel that
/// says which, or all of them.
void explain_objects(const PackObjects& objects, const Skeleton& skeleton, DrawableId drawable,
                     const std::optional<PixelRays::Hit>& hit, nlohmann::json& report) {
  constexpr size_t most = 8;
  if (objects.source().empty()) return;
  const SceneNodeId node = skeleton.drawables[drawable].scene_node;
  std::vector<SourceObjectId> shown;
  if (hit) {
    const SourceObjectId object = objects.object_at(drawable, hit->surface.placement, hit->surface.triangle);
    if (object != no_id) shown = {object};
  } else {
    shown = objects.objects_below(node);
  }
  if (shown.empty()) fmt::print("  it belongs to no object that the model's files name\n");
  if (shown.size() > 1) fmt::print("  it shows {} objects:\n", in_threes(static_cast<double>(shown.size())));
  for (size_t i = 0; i < std::min(most, shown.size()); ++i) fmt::print("{}", object_text(objects, shown[i]));
  if (shown.size() > most) fmt::print("  and {} more objects\n", shown.size() - most);
  nlohmann::json& list = report["objects"] = nlohmann::json::array();
  for (const SourceObjectId object : shown) list.push_back(to_json(objects, object));
}

int run(const ExplainCommand& command) {
  const Pack pack = open_pack(command.run.pack);
  const PackObjects objects = pack.read_objects();
  const std::vector<FrameRequest> frames = load_frames(command.run, pack.skeleton());
  if (command.frame >= frames.size()) {
    fail(command.run.path.string(), "has no frame {}: it has {}", command.frame, frames.size());
  }
  if (command.drawable && *command.drawable >= pack.skeleton().drawables.size())
    fail(fmt::format("--drawable {}", *command.drawable), "the pack has {} drawables, counted from 0",
         pack.skeleton().drawables.size());
  const ChosenDevice device = choose_device(command.run.device);
  Explainer explainer(pack, command.run.size.width, command.run.size.height, device.options);
  {
    Progress progress("frames before it", command.frame);
    for (uint32_t i = 0; i <= command.frame; ++i) {
      explainer.draw(frames[i]);
      if (i < command.frame) progress.advance();
    }
  }
  nlohmann::json report = {{"frame", command.frame}, {"pixel_error", command.run.pixel_error()}};
  if (!command.pixel.empty()) {
    const auto owner = explainer.at(command.pixel[0], command.pixel[1]);
    fmt::print("frame {}, pixel {},{}: {}\n", command.frame, command.pixel[0], command.pixel[1],
               owner ? fmt::format("drawable {}", *owner) : "background, nothing is there");
    report["pixel"] = nullptr;
    if (owner) {
      const DrawableExplanation explanation = explainer.explain(*owner);
      print(explanation, command.run.pixel_error());
      report["pixel"] = to_json(explanation);
      const FrameView view(pack.skeleton(), frames[command.frame].state);
      const int row = view.view().height - 1 - command.pixel[1];
      explain_objects(objects, pack.skeleton(), *owner,
                      PixelRays(view).hit(PackSurfaces(pack), *owner, command.pixel[0], row),
                      report["pixel"]);
    }
  }
  if (command.drawable) {
    const DrawableExplanation explanation = explainer.explain(*command.drawable);
    print(explanation, command.run.pixel_error());
    report["drawable"] = to_json(explanation);
    explain_objects(objects, pack.skeleton(), *command.drawable, std::nullopt, report["drawable"]);
  }
  add_device(report, device.names);
  write_json(command.run.json, report);
  return 0;
}

}  // namespace

void add_explain(CLI::App& app, Action& action) {
  auto command = std::make_shared<ExplainCommand>();
  CLI::App* sub =
      app.add_subcommand("explain", "Explain why a pixel shows what it shows, and why something is missing");
  sub->footer("Example: triptych explain scene.tpk --path walk.json --frame 17 --pixel 250,300");
  add_shown_run_flags(*sub, command->run, command->model);
  sub->add_option("--frame", command->frame, "The frame of the path")
      ->required()
      ->check(whole_number(0, max_frames));
  sub->add_option("--pixel", command->pixel, "The pixel, counted from the left and the top")
      ->delimiter(',')
      ->expected(2)
      ->check(whole_number(0, std::numeric_limits<int>::max()))
      ->type_name("X,Y");
  sub->add_option("--drawable", command->drawable, "A drawable by its id: what became of it")
      ->check(whole_number(0, no_id));
  sub->callback([command, sub, &action] {
    if (sub->count("--pixel") + sub->count("--drawable") == 0) {
      throw CLI::RequiredError("--pixel or --drawable");
    }
    check_shown_model(*sub, command->model);
    const auto& [width, height] = command->run.size;
    if (!command->pixel.empty() && (command->pixel[0] >= width || command->pixel[1] >= height))
      throw CLI::ValidationError(
          "--pixel", fmt::format("{},{} lies outside of a picture of {}x{}: from 0,0 to {},{}",
                                 command->pixel[0], command->pixel[1], width, height, width - 1, height - 1));
    action = [command] {
      command->run.pack = pack_of(command->model, {command->run.json});
      return run(*command);
    };
  });
}

}  // namespace triptych
