#include "sim/base/xml_text.hpp"

#include <gtest/gtest.h>

namespace articular::sim {

TEST(XmlText, LeavesNothingThatXmlTakesForItsOwn) {
  EXPECT_EQ(xml_text("a < b & \"c\" > d"), "a &lt; b &amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(xml_text("Kiefer, groß"), "Kiefer, groß");
}

}  // namespace articular::sim
