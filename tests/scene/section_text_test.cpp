#include "scene/section_text.hpp"

#include "base/error.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

TEST(SectionText, names_what_is_kept) {
  EXPECT_EQ(read_section_plane("x<12.5", "test"), (SectionPlane{{-1, 0, 0}, -12.5}));
  EXPECT_EQ(read_section_plane(" Z > -3 ", "test"), (SectionPlane{{0, 0, 1}, -3}));
  EXPECT_EQ(read_section_plane("0, -1,0,2e1", "test"), (SectionPlane{{0, -1, 0}, 20}));
  EXPECT_EQ(read_section_box("-1,0,1,2,3,4", "test"), (Box{{-1, 0, 1}, {2, 3, 4}}));
}

TEST(SectionText, comes_back_to_the_bit) {
  const SectionPlane plane{{0.1, -1.0 / 3, 1e-300}, 12345.678901234567};
  EXPECT_EQ(read_section_plane(section_words(plane), "test"), plane);
  const Box box{{-1.0 / 7, 0, 1e20}, {1, 2, 1e21}};
  EXPECT_EQ(read_section_box(section_words(box), "test"), box);
}

TEST(SectionText, refuses_other_words_with_an_example) {
  for (const std::string words :
       {"", "x", "x=1", "w<1", "x<", "x<a", "1,2,3", "1,2,3,4,5", "1,2,3,", "nan,0,0,1", "x<1e999"}) {
    try {
      read_section_plane(words, "--section");
      FAIL() << words;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("x<12.5"), std::string::npos) << error.what();
    }
  }
  for (const std::string words : {"", "1,2,3,4,5", "1,2,3,4,5,6,7", "a,b,c,d,e,f"})
    EXPECT_THROW(read_section_box(words, "test"), Error) << words;
}

}  // namespace
}  // namespace triptych
