#include "report/html.hpp"

#include <gtest/gtest.h>

namespace triptych {

TEST(Html, what_would_be_markup_is_escaped) {
  EXPECT_EQ(escape_html("a <b> & \"c\" 'd'"), "a &lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
}

TEST(Html, thousands_are_grouped_before_the_point_only) {
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1234567), "1\u202f234\u202f567");
  EXPECT_EQ(grouped(-1234.5678, 4), "-1\u202f234.5678");
}

}  // namespace triptych
