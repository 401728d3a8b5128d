// Which objects a word means, and what is said where it means none.
#include "scene/object_words.hpp"

#include "base/error.hpp"
#include "scene/file_objects.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

using Ids = std::vector<SourceObjectId>;

SourceObjects some_objects() {
  SourceObjects source;
  const auto text = [&](std::string_view letters) { return source.texts.add(letters); };
  const uint32_t upper = text("Upper Floor");
  source.objects = {
      {.name = text("hall.ifc"), .type = text(file_object_type)},
      {.name = text("Wall 1"),
       .type = text("IfcWall"),
       .layer = text("A-WALL"),
       .storey = upper,
       .parent = 0},
      {.name = text("Wall 12"), .type = text("IfcWall"), .guid = text("2ABc"), .layer = text("A-WALL-FULL")},
      {.name = text("hall.ifc"), .type = text("IfcBuilding"), .storey = upper, .number = text("#12")}};
  return source;
}

TEST(ObjectWords, a_kind_and_a_name_mean_those_that_are_called_so) {
  const SourceObjects source = some_objects();
  EXPECT_EQ(ObjectFinder(source).find("layer:a-wall"), Ids{1});
  EXPECT_EQ(ObjectFinder(source).find("storey:upper floor"), (Ids{1, 3}));
  EXPECT_EQ(ObjectFinder(source).find("Type:IFCWALL"), (Ids{1, 2}));
  EXPECT_EQ(ObjectFinder(source).find("name:Wall 1"), Ids{1});
  EXPECT_EQ(ObjectFinder(source).find("name:hall.ifc"), (Ids{0, 3}));
  EXPECT_EQ(ObjectFinder(source).find("file:hall.ifc"), Ids{0});
  EXPECT_EQ(ObjectFinder(source).find("guid:2abc"), Ids{2});
  EXPECT_EQ(ObjectFinder(source).find("number:#12"), Ids{3});
  EXPECT_EQ(ObjectFinder(source).find("layer:"), Ids());
}

TEST(ObjectWords, any_other_word_means_those_that_hold_it) {
  const SourceObjects source = some_objects();
  EXPECT_EQ(ObjectFinder(source).find("wall 1"), (Ids{1, 2}));
  EXPECT_EQ(ObjectFinder(source).find("#12"), Ids{3});
  EXPECT_EQ(ObjectFinder(source).find("color:red"), Ids());
  EXPECT_EQ(ObjectFinder(source).find(""), (Ids{0, 1, 2, 3}));
}

TEST(ObjectWords, a_word_that_means_nothing_is_refused_with_the_nearest_that_does) {
  const SourceObjects source = some_objects();
  const auto error_of = [&](const std::string& word) -> std::string {
    try {
      ObjectFinder(source).require(word, "--hide");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of("layer:A-WALL"), "");
  EXPECT_EQ(error_of("layer:A-WALK"),
            "--hide: no object of 4 is meant by \"layer:A-WALK\"; did you mean layer:a-wall?");
  EXPECT_NE(error_of("IfcWell").find("did you mean ifcwall?"), std::string::npos) << error_of("IfcWell");
  EXPECT_EQ(error_of("file:cellar.step"), "--hide: no object of 4 is meant by \"file:cellar.step\"");
}

}  // namespace
}  // namespace triptych
