// Whole packs against the models that they were built from, by a judge that shares no code with the bounds.
#include "tests/support/pack_judge.hpp"

#include "base/inject.hpp"
#include "preprocess/build.hpp"
#include "preprocess/injected_rules.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

struct Case {
  const char* name;
  std::function<Model()> model;
  uint64_t missing = 0;  ///< triangles of area that welding takes: doubles
  uint32_t buckets = 1 << 18;
};

std::ostream& operator<<(std::ostream& out, const Case& one) { return out << one.name; }

/// Meshes that are placed turned, stretched to sizes from a tenth to ten, mirrored and sheared.
Model instances() {
  Model model = awkward::model_of({awkward::sphere(9, 0.5), awkward::book(4, 5), awkward::grid(14, 2, 0.3)});
  model.instances.clear();
  for (int i = 0; i < 45; ++i) {
    const double turn = 0.7 * i, size = std::pow(10.0, (i % 9) / 4.0 - 1);
    Affine transform = awkward::translation({(i % 7) * 9.0, (i / 7) * 11.0, i % 3});
    transform[0] = size * glm::dvec3(std::cos(turn), std::sin(turn), 0);
    transform[1] = size * glm::dvec3(-std::sin(turn), std::cos(turn), 0) * (i % 4 == 1 ? 1.8 : 1.0);
    transform[2] = {0, i % 5 == 2 ? size : 0, i % 3 == 1 ? -size : size};  // sheared; mirrored
    model.instances.push_back({static_cast<uint32_t>(i % 3), transform});
  }
  return model;
}

/// Rooms of boxes, some with a ball or a bolt in them.
Model rooms() {
  std::vector<Mesh> meshes;
  for (int i = 0; i < 60; ++i) {
    const glm::dvec3 lo{i % 8 * 3.0, i / 8 * 2.5, i % 3};
    meshes.push_back(awkward::box(lo, lo + glm::dvec3(2.8, 0.1, 2.4), static_cast<uint32_t>(i % 3)));
    if (i % 4 == 0) meshes.push_back(awkward::sphere(6, 0.4, lo + glm::dvec3(1, 1, 1)));
    if (i % 7 == 0) meshes.push_back(awkward::box(lo + 1.2, lo + 1.22));
  }
  return awkward::model_of(std::move(meshes));
}

/// The same in groups: of nine, placed turned, stretched and mirrored, and of two of those with a plate.
Model groups_of_instances() {
  Model model = instances();
  model.groups.push_back({{model.instances.begin(), model.instances.begin() + 9}, {}});
  model.instances.erase(model.instances.begin() + 3, model.instances.end());
  Affine mirrored = awkward::translation({70, 0, 3}), turned = awkward::translation({0, 90, 0});
  mirrored[0] = {-1.5, 0, 0};
  turned[0] = {0, 1.2, 0.4};
  turned[1] = {-0.8, 0, 0};
  model.groups.push_back({{{2, awkward::translation({0, -4, 0})}}, {{0, Affine(1)}, {0, mirrored}}});
  model.group_instances = {{1, awkward::translation({0, 20, 0})},
                           {1, turned},
                           {1, awkward::translation({0, 20, 30})},
                           {0, turned},
                           {0, awkward::translation({100, 0, 0})}};
  return model;
}

const std::vector<Case> cases = {
    {"a_closed_surface_in_parts", [] { return awkward::model_of({awkward::wavy_sphere(40)}); }},
    {"a_closed_surface_in_buckets", [] { return awkward::model_of({awkward::wavy_sphere(40)}); }, 0, 2000},
    {"a_soup", [] { return awkward::model_of({awkward::soup(1500)}); }},
    {"instances", instances},
    {"rooms", rooms},
    {"groups", groups_of_instances},
    {"sheets_on_one_spine", [] { return awkward::model_of({awkward::book(7, 12)}); }},
    {"a_flat_plate", [] { return awkward::model_of({awkward::grid(40, 30)}); }}};

struct Recipe {
  const char* name;
  Simplifier simplifier;
  Bound bound;
};

std::ostream& operator<<(std::ostream& out, const Recipe& one) { return out << one.name; }

BuildOptions options_of(const Recipe& recipe) {
  BuildOptions options;
  options.part_triangles = 600;
  options.leaf_triangles = 800;
  options.simplify.simplifier = recipe.simplifier;
  options.simplify.bound = recipe.bound;
  return options;
}

judge::Verdict verdict_of(const Case& one, BuildOptions options, const std::string& name) {
  options.bucket_triangles = one.buckets;
  options.rules = injected_build_rules();
  const auto file = std::filesystem::path(testing::TempDir()) /
                    ("triptych_judge_" + std::to_string(::getpid()) + name + ".tpk");
  const Model model = one.model();
  build_pack(model, options, file);
  const judge::Verdict verdict = judge::judge_pack(Pack(file), model);
  std::filesystem::remove(file);
  return verdict;
}

class PackJudge : public testing::TestWithParam<std::tuple<Case, Recipe>> {};

TEST_P(PackJudge, finds_every_drawable_within_its_bound_of_the_model) {
  const auto& [one, recipe] = GetParam();
  const judge::Verdict verdict = verdict_of(one, options_of(recipe), std::string(one.name) + recipe.name);
  EXPECT_EQ(verdict.missing, one.missing);
  EXPECT_EQ(verdict.lies.size(), 0u) << verdict.lies[0];
  EXPECT_GT(verdict.drawables, 4u);
  // Neither is the judge blind nor are all bounds idle.
  if (one.name != std::string("a_flat_plate")) {
    EXPECT_GT(verdict.closest, recipe.bound == Bound::tight ? 0.5 : 0.2);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, PackJudge,
    testing::Combine(testing::ValuesIn(cases),
                     testing::Values(Recipe{"fast", Simplifier::collapse, Bound::fast},
                                     Recipe{"tight", Simplifier::collapse, Bound::tight},
                                     Recipe{"openmesh", Simplifier::openmesh, Bound::fast},
                                     Recipe{"meshopt", Simplifier::meshopt, Bound::fast})),
    [](const auto& of) {
      return std::string(std::get<0>(of.param).name) + "_" + std::get<1>(of.param).name;
    });

class PackJudgeItself : public testing::TestWithParam<const char*> {
 protected:
  void TearDown() override { clear_injected(); }
};

TEST_P(PackJudgeItself, finds_bounds_that_promise_too_much) {
  ASSERT_TRUE(inject(GetParam()));
  const Recipe recipe{"fault", Simplifier::collapse, Bound::tight};
  size_t lies = 0;
  for (const size_t which : {0u, 3u, 4u})
    lies += verdict_of(cases[which], options_of(recipe), GetParam()).lies.size();
  EXPECT_GT(lies, 0u);
}

INSTANTIATE_TEST_SUITE_P(Faults, PackJudgeItself,
                         testing::Values("uncounted-lattice", "dropped-singular-value", "shrinking-bounds"));

TEST(PackJudgeAlone, misses_a_triangle_that_the_pack_does_not_show) {
  const auto file = std::filesystem::path(testing::TempDir()) / "triptych_judge_missing.tpk";
  Model model = rooms();
  build_pack(model, {}, file);
  model.meshes[0].triangles.push_back(model.meshes[0].triangles[0]);
  model.meshes[0].triangles.back().vertices[0] = model.meshes[0].triangles[5].vertices[1];
  EXPECT_EQ(judge::judge_pack(Pack(file), model).missing, 1u);
}

}  // namespace
}  // namespace triptych
