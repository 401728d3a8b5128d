// Animations of glTF files: what becomes of them, and those that are none.
#include "gltf_support.hpp"

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

namespace triptych {
namespace {

using nlohmann::json;
using test::import_json;
using test::json_error;
using test::square;
using test::warns;

/// Accessors of floats in a buffer of their own.
class Floats {
 public:
  explicit Floats(json& document, std::string file = "moves.bin")
      : document_(document), buffer_(document["buffers"].size()), file_(std::move(file)) {
    document["buffers"].push_back({{"uri", file_}, {"byteLength", 0}});
  }
  size_t add(const std::vector<float>& values, const char* type, size_t components) {
    document_["bufferViews"].push_back(
        {{"buffer", buffer_}, {"byteOffset", bytes_.size()}, {"byteLength", 4 * values.size()}});
    for (const float value : values) test::append(bytes_, value);
    document_["accessors"].push_back({{"bufferView", document_["bufferViews"].size() - 1},
                                      {"componentType", 5126},
                                      {"count", values.size() / components},
                                      {"type", type}});
    document_["buffers"][buffer_]["byteLength"] = bytes_.size();
    test::write_model(file_, bytes_);
    return document_["accessors"].size() - 1;
  }

 private:
  json& document_;
  size_t buffer_;
  std::string file_, bytes_;
};

json channel(size_t node, const char* path, size_t sampler) {
  return {{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
}

/// A square on an arm (node 0) that turns, on a cart (node 1) that runs; another one stands.
json cart() {
  json document = square();
  document["nodes"] = json::parse(R"([{"mesh": 0, "translation": [0, 1, 0], "name": "arm"},
    {"children": [0, 2], "translation": [1, 0, 0], "name": "cart"},
    {"mesh": 0, "scale": [2, 2, 2], "name": "box"}, {"mesh": 0, "name": "stands"}])");
  document["scenes"][0]["nodes"] = {1, 3};
  Floats floats(document);
  const size_t times = floats.add({0, 2}, "SCALAR", 1), ways = floats.add({0, 0, 0, 4, 0, 0}, "VEC3", 3),
               keys = floats.add({0, 1}, "SCALAR", 1),
               turns = floats.add({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4", 4);
  document["animations"] = {{{"channels", {channel(1, "translation", 0), channel(0, "rotation", 1)}},
                             {"samplers",
                              {{{"input", times}, {"output", ways}},
                               {{"input", keys}, {"output", turns}, {"interpolation", "LINEAR"}}}}}};
  return document;
}

const GroupInstance& placed(const Model& model, size_t triangles_of_group) {
  return *std::ranges::find_if(model.group_instances, [&](const GroupInstance& instance) {
    return model.groups[instance.group].instances.size() == triangles_of_group &&
           model.motion.joints[instance.joint].parent != no_id;
  });
}

TEST(ImportGltfMotion, what_moves_is_apart_from_what_stands) {
  const Model model = import_json(cart());
  ASSERT_EQ(model.instances.size(), 1u);
  ASSERT_EQ(model.group_instances.size(), 2u) << "the cart with its box, and the arm";
  ASSERT_EQ(model.motion.joints.size(), 2u);
  for (const GroupInstance& instance : model.group_instances) {
    ASSERT_NE(instance.joint, no_id);
    EXPECT_EQ(instance.transform, transform_at(model.motion, instance.joint, 0));
    EXPECT_EQ(model.groups[instance.group].instances.size(), 1u);
  }
  const GroupInstance& arm = placed(model, 1);
  const Affine there = transform_at(model.motion, arm.joint, 0.5);
  // A quarter of the way along, up the arm, a quarter turn.
  EXPECT_LT(glm::distance(there * glm::dvec4(1, 0, 0, 1), glm::dvec3(1, 2, 0)), 1e-6);
  EXPECT_TRUE(model.report.warnings.empty());
  // The clip is two seconds long, also for the arm, whose keys end after one.
  EXPECT_EQ(transform_at(model.motion, arm.joint, 1.5), transform_at(model.motion, arm.joint, 3.5));
  EXPECT_LT(glm::distance(transform_at(model.motion, arm.joint, 1.9)[0], glm::dvec3(-1, 0, 0)), 1e-6);
}

TEST(ImportGltfMotion, objects_keep_their_names) {
  const Model model = import_json(cart());
  for (const GroupInstance& instance : model.group_instances) {
    const SourceObjectId object =
        object_in(instance.first_object, model.groups[instance.group].instances[0].object);
    const std::string name(model.source_objects.texts[model.source_objects.objects.at(object).name]);
    EXPECT_EQ(name, model.motion.joints[instance.joint].parent == no_id ? "box" : "arm");
  }
}

TEST(ImportGltfMotion, what_is_kept_where_it_rests_does_not_move) {
  json document = cart();
  Floats floats(document, "rests.bin");
  const size_t times = floats.add({0, 2}, "SCALAR", 1), ways = floats.add({1, 0, 0, 1, 0, 0}, "VEC3", 3);
  document["animations"] = {
      {{"channels", {channel(1, "translation", 0)}}, {"samplers", {{{"input", times}, {"output", ways}}}}}};
  const Model model = import_json(document);
  EXPECT_TRUE(model.group_instances.empty());
  EXPECT_EQ(model.instances.size(), 3u);
}

TEST(ImportGltfMotion, what_is_not_played_is_counted_once) {
  json document = cart();
  document["animations"][0]["channels"].push_back(channel(0, "weights", 0));
  document["animations"].push_back(document["animations"][0]);
  const Model model = import_json(document);
  EXPECT_TRUE(warns(model, "2 animations of weights or of what is no node are not played"));
  EXPECT_TRUE(warns(model, "2 animations move what another one moves already, and are not played"));
}

TEST(ImportGltfMotion, animations_that_are_none_are_refused_with_their_place) {
  const auto error = [](const std::function<void(json&)>& spoil) {
    json document = cart();
    spoil(document);
    return json_error(document);
  };
  const auto sampler = [](json& document, size_t i) -> json& {
    return document["animations"][0]["samplers"][i];
  };
  const auto expect = [&](const std::function<void(json&)>& spoil, const std::string& words) {
    const std::string found = error(spoil);
    EXPECT_NE(found.find("animation 0: channel "), std::string::npos) << found;
    EXPECT_NE(found.find(words), std::string::npos) << found;
  };
  expect([](json& d) { d["animations"][0]["channels"][1]["target"]["path"] = "colour"; }, "moves \"colour\"");
  expect([](json& d) { d["animations"][0]["channels"][1]["target"]["node"] = 9; }, "names node 9 of 4");
  expect([](json& d) { d["animations"][0]["channels"][1]["sampler"] = 7; }, "names sampler 7 of 2");
  expect([](json& d) { d["animations"][0]["channels"][1].erase("sampler"); }, "names sampler -1 of 2");
  expect([&](json& d) { sampler(d, 0)["interpolation"] = "SMOOTH"; }, "interpolates by \"SMOOTH\"");
  expect([&](json& d) { sampler(d, 0)["interpolation"] = "CUBICSPLINE"; }, "2 values for 2 keys, where 6");
  expect([&](json& d) { sampler(d, 0)["output"] = 2; }, "values of 1 numbers, where 3");
  expect([&](json& d) { sampler(d, 0)["input"] = 99; }, "names accessor 99");
  expect([](json& d) { d["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
         "moves node 0, which has a matrix");
  for (const auto& [times, words] : {std::pair(std::vector<float>{1, 1}, "its times do not increase"),
                                     {{-1, 1}, "begins before 0"},
                                     {{0, NAN}, "is not a finite number"}}) {
    expect(
        [&](json& d) {
          Floats floats(d, "times.bin");
          sampler(d, 0)["input"] = floats.add(times, "SCALAR", 1);
        },
        words);
  }
}

}  // namespace
}  // namespace triptych
