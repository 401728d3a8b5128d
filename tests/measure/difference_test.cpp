// Two revisions of a model: what of them is the same, and what became of the rest.
#include "measure/difference/difference_model.hpp"
#include "preprocess/build.hpp"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <unistd.h>

namespace triptych {
namespace {

/// A box that is a source object.
struct Thing {
  std::string name;
  glm::dvec3 at{0};
  glm::dvec3 size{1, 2, 3};
  uint32_t color = 1;
  double turned = 0;  ///< degrees about z
  std::string guid = {};
};

constexpr size_t grid = 6;  ///< squares of a box's side, in each direction

void add_box(const Thing& thing, Mesh& mesh) {
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (size_t i = 0; i < grid * grid; ++i) {
      const auto first = static_cast<uint32_t>(mesh.positions.size());
      for (size_t corner = 0; corner < 4; ++corner) {
        glm::dvec3 at(0);
        at[axis] = side % 2;
        at[u] = static_cast<double>(i / grid + corner / 2) / grid;
        at[v] = static_cast<double>(i % grid + corner % 2) / grid;
        mesh.positions.push_back(at * thing.size);
      }
      mesh.triangles.push_back({{first, first + 1, first + 3}, thing.color});
      mesh.triangles.push_back({{first, first + 3, first + 2}, thing.color});
    }
  }
}

Model model_of(const std::vector<Thing>& things) {
  Model model;
  for (const float red : {0.8f, 0.1f, 0.5f}) model.materials.push_back({{red, 0.3f, 0.6f, 1}});
  model.files = {"things"};
  const auto text = [&](const std::string& words) {
    return words.empty() ? 0 : model.source_objects.texts.add(words);
  };
  for (const Thing& thing : things) {
    Mesh mesh;
    add_box(thing, mesh);
    const double angle = thing.turned * 3.14159265358979323846 / 180;
    const Affine transform{glm::dvec3(std::cos(angle), std::sin(angle), 0),
                           glm::dvec3(-std::sin(angle), std::cos(angle), 0), glm::dvec3(0, 0, 1), thing.at};
    SourceObject object;
    object.name = text(thing.name);
    object.guid = text(thing.guid);
    model.source_objects.objects.push_back(object);
    const auto number = static_cast<uint32_t>(model.meshes.size());
    model.instances.emplace_back(number, transform, number);
    model.meshes.push_back(std::move(mesh));
  }
  return model;
}

class Differences : public testing::Test {
 protected:
  Differences() {
    folder = std::filesystem::path(testing::TempDir()) /
             ("differences_" + std::to_string(::getpid()) + "_" +
              testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder);
  }
  ~Differences() override { std::filesystem::remove_all(folder); }

  std::filesystem::path build(const std::vector<Thing>& things, const BuildOptions& options = {}) {
    const std::filesystem::path file = folder / (std::to_string(packs++) + ".tpk");
    build_pack(model_of(things), options, file);
    return file;
  }

  /// For each name what is said of its objects, in the order of the objects.
  static std::map<std::string, std::vector<std::string>> words(const Revision& before,
                                                               const Revision& after) {
    std::map<std::string, std::vector<std::string>> all;
    for (const ObjectChange& change : compare_packs(before, after).objects) {
      const Revision& in = change.removed() ? before : after;
      const SourceObjectId id = change.removed() ? change.object.before : change.object.after;
      const std::string name =
          id == in.shapes.nameless() ? "" : std::string(in.source().texts[in.source().objects[id].name]);
      all[name].push_back(words_of(change));
    }
    return all;
  }

  std::filesystem::path folder;
  int packs = 0;
};

using Words = std::map<std::string, std::vector<std::string>>;

const std::vector<Thing> usual = {{"wall", {0, 0, 0}}, {"door", {10, 0, 0}}, {"desk", {20, 0, 0}}};

TEST_F(Differences, a_model_that_was_built_otherwise_is_the_same) {
  const std::vector<Thing> things = {
      {"wall", {0, 0, 0}, {1, 2, 3}, 1, 17}, {"door", {10, 0, 0}}, {"desk", {20, 0, 0}}};
  const Revision plain(build(things));
  BuildOptions other;
  other.simplify.simplifier = Simplifier::meshopt;
  other.simplify.bound = Bound::tight;
  other.keep = {.touching = false, .order = true, .planes = false, .cover = false};
  other.part_triangles = 64;
  other.leaf_triangles = 64;
  const Revision again(build(things, other));
  ASSERT_NE(plain.pack.content_hash(), again.pack.content_hash());
  EXPECT_TRUE(compare_packs(plain, again).equal());
  other.share_instances = false;
  EXPECT_TRUE(compare_packs(plain, Revision(build(things, other))).equal());
}

TEST_F(Differences, what_became_of_an_object_is_told_apart) {
  const std::vector<Thing> before = {{"stays", {0, 0, 0}},    {"goes", {5, 0, 0}},   {"slides", {10, 0, 0}},
                                     {"turns", {15, 0, 0}},   {"paint", {20, 0, 0}}, {"grows", {25, 0, 0}},
                                     {"moves on", {30, 0, 0}}};
  std::vector<Thing> after = before;
  after.erase(after.begin() + 1);
  after[1].at.y += 2.5;
  after[2].turned = 30;
  after[3].color = 2;
  after[4].size.z = 3.01;
  after[5].at.x += 1, after[5].color = 2;
  after.push_back({"comes", {35, 0, 0}});
  const Revision one(build(before)), other(build(after));
  EXPECT_EQ(words(one, other), (Words{{"stays", {"unchanged"}},
                                      {"goes", {"removed"}},
                                      {"slides", {"moved"}},
                                      {"turns", {"moved"}},
                                      {"paint", {"recoloured"}},
                                      {"grows", {"reshaped"}},
                                      {"moves on", {"moved, recoloured"}},
                                      {"comes", {"added"}}}));
  for (const ObjectChange& change : compare_packs(one, other).objects) {
    if (change.object.after == 1) {
      EXPECT_NEAR(change.shape.offset.y, 2.5, 1e-5);
      EXPECT_NEAR(change.shape.turned, 0, 1e-3);
    }
    // A box looks the same after half a turn about any of its axes, but it was turned about z by 30 degrees.
    if (change.object.after == 2) {
      EXPECT_GT(change.shape.turned, 29.9);
    }
  }
  EXPECT_FALSE(compare_packs(other, one).equal()) << "the other way round";
}

TEST_F(Differences, an_object_far_away_shifts_the_lattice_and_changes_nothing_else) {
  std::vector<Thing> after = usual;
  after.push_back({"crane", {777.7, 333.3, 55.5}});
  const Revision one(build(usual)), other(build(after));
  ASSERT_NE(one.pack.skeleton().lattice(), other.pack.skeleton().lattice());
  EXPECT_EQ(
      words(one, other),
      (Words{
          {"wall", {"unchanged"}}, {"door", {"unchanged"}}, {"desk", {"unchanged"}}, {"crane", {"added"}}}));
}

TEST_F(Differences, of_several_of_one_name_those_in_one_place_are_the_same) {
  std::vector<Thing> before;
  for (int i = 0; i < 6; ++i) before.push_back({"chair", {3.0 * i, 0, 0}});
  std::vector<Thing> after = before;
  after.erase(after.begin() + 2);
  const Words all = words(Revision(build(before)), Revision(build(after)));
  EXPECT_EQ(all,
            (Words{{"chair", {"unchanged", "unchanged", "unchanged", "unchanged", "unchanged", "removed"}}}));
}

TEST_F(Differences, a_guid_stays_when_the_name_does_not) {
  std::vector<Thing> before = usual, after = usual;
  before[0].guid = after[0].guid = "0YvctVUKr0kugbFTf53O9L";
  after[0].name = "outer wall";
  const Revision one(build(before)), other(build(after));
  const PackDifference difference = compare_packs(one, other);
  ASSERT_EQ(difference.objects.size(), 3u);
  ASSERT_EQ(difference.objects[0].told.size(), 1u);
  EXPECT_EQ(difference.objects[0].told[0].what, "name");
  EXPECT_EQ(difference.objects[0].told[0].before, "wall");
  EXPECT_EQ(difference.objects[0].told[0].after, "outer wall");
  EXPECT_FALSE(difference.objects[0].shape.any());
  EXPECT_FALSE(difference.equal());
}

TEST_F(Differences, the_pack_of_both_shows_in_its_colours_what_changed) {
  std::vector<Thing> after = usual;
  after[1].size.x = 5;
  after.erase(after.begin());
  after.push_back({"lamp", {30, 0, 0}});
  const Revision one(build(usual)), other(build(after));
  const std::filesystem::path file = folder / "both.tpk";
  build_pack(difference_model(one, other, compare_packs(one, other)), {}, file);
  const Revision both(file);
  std::map<std::string, std::array<int, 3>> colors;
  std::map<std::string, std::string> states;
  for (SourceObjectId id = 0; id < both.source().objects.size(); ++id) {
    const std::string name(both.source().texts[both.source().objects[id].name]);
    const PlacedShape shape = both.shapes.shape_of(id);
    ASSERT_EQ(shape.facets.size(), 12 * grid * grid) << name;
    for (const auto& facet : shape.facets) EXPECT_EQ(facet.colors, shape.facets[0].colors);
    const VertexColor& color = shape.facets[0].colors[0];
    colors[name] = {color[0], color[1], color[2]};
    const auto property = both.source().properties_of(both.source().sets_of(id).back())[0];
    states[name] = both.source().texts[property.value];
  }
  ASSERT_EQ(colors.size(), 4u);
  EXPECT_EQ(states,
            (std::map<std::string, std::string>{
                {"wall", "gone"}, {"door", "changed: reshaped"}, {"desk", "same"}, {"lamp", "added"}}));
  EXPECT_EQ(colors["desk"][0], colors["desk"][1]) << "grey";
  EXPECT_EQ(colors["desk"][1], colors["desk"][2]);
  EXPECT_GT(colors["wall"][0], 2 * colors["wall"][1]) << "red";
  EXPECT_GT(colors["lamp"][1], 2 * colors["lamp"][0]) << "green";
  EXPECT_GT(colors["door"][0], 4 * colors["door"][2]) << "yellow";
  EXPECT_GT(colors["door"][1], 4 * colors["door"][2]);
}

TEST_F(Differences, what_has_no_name_is_compared_as_one) {
  std::vector<Thing> after = usual;
  after[2].at.x += 1;
  const auto nameless = [&](const std::vector<Thing>& things) {
    Model model = model_of(things);
    model.source_objects = {};
    for (Instance& instance : model.instances) instance.object = no_id;
    const std::filesystem::path file = folder / (std::to_string(packs++) + ".tpk");
    build_pack(std::move(model), {}, file);
    return file;
  };
  const Revision one(nameless(usual));
  EXPECT_EQ(words(one, Revision(nameless(usual))), (Words{{"", {"unchanged"}}}));
  EXPECT_EQ(words(one, Revision(nameless(after))), (Words{{"", {"reshaped"}}}));
}

}  // namespace
}  // namespace triptych
