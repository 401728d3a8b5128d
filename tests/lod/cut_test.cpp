// Cut selection: every leaf in the frustum once, each as coarse as the pixel error lets it be and no coarser.
#include "lod/cut.hpp"

#include "scene/seen_from_outside.hpp"
#include "tests/support/scenes.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace triptych {
namespace {

class CutOf : public testing::TestWithParam<std::string> {
 protected:
  const Skeleton& skeleton = scenes::pack(GetParam()).skeleton();
  const std::vector<View> views = scenes::path(skeleton, 512, 384);

  /// Whether selection finds the node beyond the frustum: itself or one of its ancestors is.
  bool beyond(const EyeSpace& eye_space, SceneNodeId node) const {
    for (; node != no_id; node = skeleton.scene_nodes[node].parent) {
      if (eye_space.bounds(skeleton.scene_nodes[node].box).outside) return true;
    }
    return false;
  }
  double error_on_screen(const View& view, DrawableId id) const {
    const Drawable& drawable = skeleton.drawables[id];
    return projected_error(
        view.focal_length(), drawable.error,
        FrameView(skeleton, {view}).eye_space.bounds(skeleton.scene_nodes[drawable.scene_node].box));
  }
  bool would_do(const View& view, DrawableId id, double pixel_error) const {
    const Drawable& drawable = skeleton.drawables[id];
    const LatticeBox& box = skeleton.scene_nodes[drawable.scene_node].box;
    return error_on_screen(view, id) <= pixel_error &&
           (!is_seen_from_outside(skeleton, drawable) ||
            FrameView(skeleton, {view}).eye_space.is_beyond_near(box));
  }
};

TEST_P(CutOf, covers_each_leaf_in_the_frustum_once) {
  for (size_t frame = 0; frame < views.size(); ++frame) {
    const Cut cut = select_cut(FrameView(skeleton, {views[frame], scenes::pixel_error(frame)}));
    const EyeSpace eye_space = FrameView(skeleton, {views[frame]}).eye_space;
    for (SceneNodeId leaf = 0; leaf < skeleton.scene_nodes.size(); ++leaf) {
      if (skeleton.scene_nodes[leaf].child_count > 0) continue;
      int covered = 0;
      for (SceneNodeId node = leaf; node != no_id; node = skeleton.scene_nodes[node].parent) {
        covered += cut.choice[node] < Cut::inner;
      }
      EXPECT_LE(covered, 1) << "leaf " << leaf << " in frame " << frame;
      if (!beyond(eye_space, leaf)) {
        EXPECT_EQ(covered, 1) << "leaf " << leaf << " in frame " << frame;
      }
    }
  }
}

TEST_P(CutOf, keeps_the_pixel_error_and_is_no_finer_than_it_must_be) {
  for (size_t frame = 0; frame < views.size(); ++frame) {
    const double pixel_error = scenes::pixel_error(frame);
    const Cut cut = select_cut(FrameView(skeleton, {views[frame], pixel_error}));
    for (const DrawableId id : cut.drawables) {
      const SceneNodeId node_id = skeleton.drawables[id].scene_node;
      const SceneNode& node = skeleton.scene_nodes[node_id];
      const bool finest = node.child_count == 0 && id == node.first_drawable;
      EXPECT_TRUE(finest || error_on_screen(views[frame], id) <= pixel_error) << "drawable " << id;
      if (id + 1 < node.first_drawable + node.drawable_count) {
        EXPECT_FALSE(would_do(views[frame], id + 1, pixel_error)) << "a coarser one would have done";
      }
      if (node.parent == no_id) continue;
      const SceneNode& parent = skeleton.scene_nodes[node.parent];
      for (uint32_t level = 0; level < parent.drawable_count; ++level) {
        EXPECT_FALSE(would_do(views[frame], parent.first_drawable + level, pixel_error))
            << "its parent would have done";
      }
    }
  }
}

TEST_P(CutOf, is_in_draw_rank_order_and_a_child_never_ranks_before_its_parent) {
  for (size_t frame = 0; frame < views.size(); ++frame) {
    const glm::ivec3 cell = eye_cell(skeleton, views[frame]);
    const Cut cut = select_cut(FrameView(skeleton, {views[frame], scenes::pixel_error(frame)}));
    for (size_t i = 1; i < cut.drawables.size(); ++i) {
      EXPECT_LT(draw_rank(skeleton, cell, cut.drawables[i - 1]), draw_rank(skeleton, cell, cut.drawables[i]));
    }
    for (DrawableId id = 0; id < skeleton.drawables.size(); ++id) {
      const SceneNodeId parent = skeleton.scene_nodes[skeleton.drawables[id].scene_node].parent;
      if (parent == no_id || skeleton.scene_nodes[parent].drawable_count == 0) continue;
      EXPECT_LT(draw_rank(skeleton, cell, skeleton.scene_nodes[parent].first_drawable),
                draw_rank(skeleton, cell, id));
    }
  }
}

TEST_P(CutOf, only_moves_up_the_hierarchy_as_the_pixel_error_grows) {
  for (const View& view : views) {
    Cut finer = select_cut(FrameView(skeleton, {view, 0}));
    for (const double pixel_error : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 64.0, 4096.0}) {
      Cut coarser = select_cut(FrameView(skeleton, {view, pixel_error}));
      for (const DrawableId id : finer.drawables) {
        SceneNodeId node = skeleton.drawables[id].scene_node;
        while (node != no_id && !(coarser.choice[node] < Cut::inner))
          node = skeleton.scene_nodes[node].parent;
        ASSERT_NE(node, no_id) << "nothing stands for drawable " << id << " at " << pixel_error << " pixels";
        if (node == skeleton.drawables[id].scene_node) {
          EXPECT_GE(coarser.choice[node], id) << "a finer level at a larger pixel error";
        }
      }
      finer = std::move(coarser);
    }
  }
}

TEST_P(CutOf, at_a_pixel_error_of_zero_is_full_detail) {
  for (const View& view : views) {
    for (const DrawableId id : select_cut(FrameView(skeleton, {view, 0})).drawables) {
      const SceneNode& node = skeleton.scene_nodes[skeleton.drawables[id].scene_node];
      EXPECT_EQ(node.child_count, 0u);
      EXPECT_EQ(id, node.first_drawable);
    }
  }
}

TEST_P(CutOf, is_the_same_when_selected_again) {
  for (const View& view : views) {
    const Cut one = select_cut(FrameView(skeleton, {view, 1})),
              other = select_cut(FrameView(skeleton, {view, 1}));
    EXPECT_EQ(one.drawables, other.drawables);
    EXPECT_EQ(one.choice, other.choice);
  }
}

TEST_P(CutOf, without_frustum_culling_holds_the_whole_model_and_the_cut_itself) {
  for (const View& view : views) {
    const Cut cut = select_cut(FrameView(skeleton, {view, 1})),
              all = select_cut(FrameView(skeleton, {view, 1}), FrustumCulling::off);
    for (SceneNodeId leaf = 0; leaf < skeleton.scene_nodes.size(); ++leaf) {
      if (skeleton.scene_nodes[leaf].child_count > 0) continue;
      int covered = 0;
      for (SceneNodeId node = leaf; node != no_id; node = skeleton.scene_nodes[node].parent) {
        covered += all.choice[node] < Cut::inner;
      }
      EXPECT_EQ(covered, 1) << "leaf " << leaf;
    }
    for (const DrawableId id : cut.drawables) EXPECT_EQ(all.choice[skeleton.drawables[id].scene_node], id);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CutOf, testing::ValuesIn(scenes::names()),
                         [](const auto& parameter) { return parameter.param; });

TEST_P(CutOf, has_no_level_that_is_made_to_be_seen_from_outside_where_the_near_plane_may_cut_it) {
  Skeleton marked = skeleton;
  marked.seen_from_outside.assign(marked.chunks.size(), true);
  for (const SceneNode& node : marked.scene_nodes) {
    if (node.child_count > 0) continue;
    const Drawable& finest = marked.drawables[node.first_drawable];
    for (uint32_t i = 0; i < finest.placement_count; ++i)
      marked.seen_from_outside[marked.placements[finest.first_placement + i].chunk] = false;
  }
  size_t refined = 0;
  for (size_t frame = 0; frame < views.size(); ++frame) {
    for (const double pixel_error : {1.0, 1e6}) {
      const FrameView view(marked, {views[frame], pixel_error});
      for (const DrawableId id : select_cut(view).drawables) {
        const Drawable& drawable = marked.drawables[id];
        const bool may_be_cut = !view.eye_space.is_beyond_near(marked.scene_nodes[drawable.scene_node].box);
        EXPECT_FALSE(may_be_cut && is_seen_from_outside(marked, drawable)) << "drawable " << id;
      }
      const auto drawn = [&](const Skeleton& of) {
        return select_cut(FrameView(of, {views[frame], pixel_error})).drawables;
      };
      refined += drawn(marked) != drawn(skeleton);
    }
  }
  if (GetParam() == "room") {
    EXPECT_GT(refined, 0) << "the rule changed nothing";
  }
}

TEST(Cut, coarse_drawables_are_chosen_from_far_away) {
  const Skeleton& skeleton = scenes::pack("instances").skeleton();
  View near_view = scenes::path(skeleton, 512, 512).front();
  View far_view = near_view;
  far_view.camera.eye = near_view.camera.eye * 400.0;
  const size_t near_size = select_cut(FrameView(skeleton, {near_view, 1})).drawables.size();
  EXPECT_GT(near_size, 10u);
  EXPECT_LT(select_cut(FrameView(skeleton, {far_view, 1}), FrustumCulling::off).drawables.size(),
            near_size / 4);
}

/// A box beside or around the eye and a view of it, at random.
struct Trial {
  Skeleton skeleton;
  View view;
  LatticeBox box;

  explicit Trial(scenes::Random& random) {
    skeleton.lattices = {Lattice{{0, 0, 0}, 0x1p-10}};
    view.width = 1 + static_cast<int>(random.index(2000));
    view.height = 1 + static_cast<int>(random.index(2000));
    view.camera.eye = random.vector(-20, 20);
    view.camera.target = view.camera.eye + random.vector(-1, 1);
    view.camera.up = random.vector(-1, 1);
    view.camera.left = random.number(-3, 0.5);
    view.camera.right = view.camera.left + random.number(0.01, 3);
    view.camera.bottom = random.number(-3, 0.5);
    view.camera.top = view.camera.bottom + random.number(0.01, 3);
    view.camera.near = std::exp2(random.number(-10, 2));
    if (random.index(4) == 0) {
      view.camera.projection = Projection::orthographic;
      for (double* side : {&view.camera.left, &view.camera.right, &view.camera.bottom, &view.camera.top})
        *side *= 8;
    }
    const glm::dvec3 lo = random.vector(-20, 20);
    box = skeleton.lattice().enclosing({lo, lo + random.vector() * std::exp2(random.number(-6, 4))});
  }
  glm::dvec3 point(scenes::Random& random) const {
    const Box model_box = skeleton.lattice().box(box);
    return model_box.lo + (model_box.hi - model_box.lo) * random.vector();
  }
};

using Precise = glm::vec<3, long double>;

/// Eye space of a model-space point, in long double.
Precise to_eye(const View& view, const glm::dvec3& point) {
  const glm::mat<3, 3, long double> rotation(view.rotation());
  return rotation * (Precise(point) - Precise(view.camera.eye));
}

bool in_frustum(const Camera& camera, const Precise& p) {
  const long double depth = -p.z;
  if (camera.orthographic()) {
    return depth >= camera.near && p.x >= camera.left && p.x <= camera.right && p.y >= camera.bottom &&
           p.y <= camera.top;
  }
  return depth >= camera.near && p.x >= camera.left * depth && p.x <= camera.right * depth &&
         p.y >= camera.bottom * depth && p.y <= camera.top * depth;
}

TEST(ProjectedError, bounds_how_far_any_displaced_point_of_the_box_moves) {
  scenes::Random random(21);
  int points = 0;
  double tightest = 0;
  for (int round = 0; round < 20000; ++round) {
    const Trial trial(random);
    const EyeBounds bounds =
        EyeSpace(trial.skeleton, trial.view, trial.view.rotation(), {}).bounds(trial.box);
    const double error = std::exp2(random.number(-12, 1));
    const double bound = projected_error(trial.view.focal_length(), error, bounds);
    for (int i = 0; i < 20; ++i) {
      const Precise at = to_eye(trial.view, trial.point(random));
      if (!in_frustum(trial.view.camera, at)) continue;
      EXPECT_FALSE(bounds.outside) << "a box with a point in the frustum";
      if (std::isinf(bound)) continue;
      // The worst displacement, and others: towards the eye and away from the axis.
      Precise aside = i % 2 ? Precise(at.x, at.y, at.z * -(at.x * at.x + at.y * at.y) / (at.z * at.z))
                            : Precise(random.vector(-1, 1));
      if (!(glm::length(aside) > 0)) continue;
      const Precise moved = at + glm::normalize(aside) * static_cast<long double>(error);
      const bool parallel = trial.view.camera.orthographic();
      const long double w0 = parallel ? 1 : -at.z, w1 = parallel ? 1 : -moved.z;
      const long double x = (moved.x / w1 - at.x / w0) * trial.view.focal_x();
      const long double y = (moved.y / w1 - at.y / w0) * trial.view.focal_y();
      const auto movement = static_cast<double>(std::hypot(x, y));
      EXPECT_LE(movement, bound * (1 + 1e-12));
      tightest = std::max(tightest, movement / bound);
      ++points;
    }
  }
  EXPECT_GT(points, 1000);
  EXPECT_GT(tightest, 0.9) << "a bound that is never nearly reached tests little";
}

TEST(ProjectedError, of_an_orthographic_view_does_not_depend_on_depth) {
  for (const double depth : {-5.0, 0.5, 1e9})
    EXPECT_EQ(projected_error(40, 0.5, {.min_depth = depth, .parallel = true}), 20);
}

TEST(ProjectedError, is_infinite_where_the_surface_may_reach_the_eye) {
  EXPECT_TRUE(std::isinf(projected_error(500, 1, {.min_depth = 1, .outside = false, .stretch = 1})));
  EXPECT_TRUE(std::isinf(projected_error(500, 1, {.min_depth = -3, .outside = false, .stretch = 1})));
  EXPECT_TRUE(std::isinf(projected_error(500, 0, {.min_depth = 0, .outside = false, .stretch = 1})));
  EXPECT_EQ(projected_error(500, 0, {.min_depth = 1, .outside = false, .stretch = 2}), 0);
  EXPECT_DOUBLE_EQ(projected_error(500, 1, {.min_depth = 6, .outside = false, .stretch = 2}), 200);
}

}  // namespace
}  // namespace triptych
