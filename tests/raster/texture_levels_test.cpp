// Levels of textures within a cap: what goes, what shows coarser, and what is counted.
#include "raster/texture_levels.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

/// Gives white texels.
class WhiteTexels final : public Residency {
 public:
  explicit WhiteTexels(const Skeleton& skeleton) : skeleton_(skeleton) {}
  void expect(uint32_t, float) override {}
  Chunk take(uint32_t) override { return {}; }
  std::optional<Chunk> take_if_ready(uint32_t) override { return std::nullopt; }
  std::vector<Texel> read_texels(uint32_t texture, uint32_t level) override {
    const Texture& own = skeleton_.textures[texture];
    return std::vector<Texel>(size_t{side_at_level(own.width, level)} * side_at_level(own.height, level),
                              Texel{255, 255, 255, 255});
  }

 private:
  const Skeleton& skeleton_;
};

/// Textures of 64 by 64 texels, whose levels take 16384, 4096, 1024 ... bytes.
class TextureCaps : public testing::Test {
 protected:
  TextureCaps() {
    skeleton.textures.assign(3, {64, 64, std::vector<TextureLevel>(texture_levels(64, 64), {0, 10, 0})});
    levels.emplace(skeleton, texels);
  }
  /// Asks for the finest levels of textures, as colours do that show them, until they fit; how often.
  int show(const std::vector<uint32_t>& textures) {
    levels->begin_view();
    int passes = 0;
    do {
      ++passes;
      for (const uint32_t texture : textures) levels->texels_within_cap(texture, levels->shown(texture, 0));
    } while (!levels->fit());
    return passes;
  }

  Skeleton skeleton;
  WhiteTexels texels{skeleton};
  std::optional<TextureLevels> levels;
};

TEST_F(TextureCaps, count_what_is_read_and_what_was_there) {
  EXPECT_EQ(show({0, 1}), 1);
  EXPECT_EQ(show({0}), 1);
  const TextureUse use = levels->use();
  EXPECT_EQ(use.misses, 2u);
  EXPECT_EQ(use.hits, 1u);
  EXPECT_EQ(use.read_bytes, 20u);
  EXPECT_EQ(use.decoded_bytes, 2u * 16384);
  EXPECT_EQ(use.bytes, use.peak_bytes);
  EXPECT_EQ(use.coarser_views + use.over_cap_views + use.evicted, 0u);
}

TEST_F(TextureCaps, let_go_what_earlier_views_asked_for_first) {
  levels->set_cap(2 * 16384);
  show({0, 1});
  EXPECT_GE(show({1, 2}), 1);
  const TextureUse use = levels->use();
  EXPECT_LE(use.peak_bytes, 2u * 16384);
  EXPECT_EQ(use.evicted, 1u);
  EXPECT_EQ(use.coarser_views, 0u) << "both have room";
}

TEST_F(TextureCaps, show_coarser_levels_where_one_view_asks_for_more_and_finer_ones_again_later) {
  levels->set_cap(2 * 16384);
  EXPECT_GT(show({0, 1, 2}), 1);
  EXPECT_EQ(levels->shown(0, 0), 1u);
  TextureUse use = levels->use();
  EXPECT_EQ(use.coarser_views, 1u);
  EXPECT_EQ(use.over_cap_views, 0u);
  EXPECT_LE(use.peak_bytes, 2u * 16384);
  EXPECT_EQ(use.bytes, 3u * 4096);
  show({0});
  show({0});
  EXPECT_EQ(levels->shown(0, 0), 0u) << "one alone has room for all of its levels";
  EXPECT_LE(levels->use().peak_bytes, 2u * 16384);
}

TEST_F(TextureCaps, are_passed_by_levels_that_say_where_holes_are_which_is_counted) {
  levels->set_cap(5000);
  levels->begin_view();
  EXPECT_NE(levels->texels(0, 0), nullptr);
  EXPECT_NE(levels->texels(1, 0), nullptr);
  EXPECT_TRUE(levels->fit()) << "no colour was refused";
  EXPECT_EQ(levels->use().over_cap_views, 1u);
  levels->begin_view();
  EXPECT_EQ(levels->use().bytes, 2u * 16384) << "the view before has just asked for them";
  levels->begin_view();
  EXPECT_LE(levels->use().bytes, 5000u);
}

TEST_F(TextureCaps, of_next_to_nothing_end_with_a_picture_all_the_same) {
  levels->set_cap(1);
  EXPECT_LT(show({0, 1, 2}), 20);
  const TextureUse use = levels->use();
  EXPECT_EQ(use.coarser_views, 1u);
  EXPECT_EQ(use.over_cap_views, 1u);
}

}  // namespace
}  // namespace triptych
