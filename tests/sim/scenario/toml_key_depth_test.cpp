#include "sim/scenario/toml_key_depth.hpp"

#include <gtest/gtest.h>

#include <string>

#include "sim/base/error.hpp"
#include "sim/scenario/toml_document.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim {
namespace {

TEST(TomlKeyDepth, CountsPartsOfKeysAndOfNothingElse) {
  EXPECT_EQ(deepest_key("a = 1").parts, 0);
  EXPECT_EQ(deepest_key("a.b.c = 1").parts, 3);
  EXPECT_EQ(deepest_key("[[a.b]]\nc = 1").parts, 2);
  EXPECT_EQ(deepest_key("a = [0.1, 0.2, 0.3, 0.4]").parts, 3);  // a number looks like two parts
  EXPECT_EQ(deepest_key("a = 'x.y.z' # u.v.w").parts, 0);
  EXPECT_EQ(deepest_key("\"a.b.c\".'d.e'.f = 1").parts, 3);
  EXPECT_EQ(deepest_key("a = \"\\\" # \" \nb.c.d = 1").parts, 3);
  EXPECT_EQ(deepest_key("a = \"\"\"x\n\"y.z.w\n\"\"\"\nb.c = 1").parts, 2);
  EXPECT_EQ(deepest_key("a = { b.c.d.e = 1 }").parts, 5);
  EXPECT_EQ(deepest_key("a.b = { c = [{ d.e = 1 }] }").parts, 5);
  EXPECT_EQ(deepest_key("a.b = { c = 1 }\nd.e = 1").parts, 2);
  EXPECT_EQ(deepest_key("a.b = [{ c.d = 1 }, { e.f = 1 }]\n[g.h]\n]}]}i.j = 1").parts, 4);
  EXPECT_EQ(deepest_key("a = 1\nb = '''\n'''\nc.d = 1").line, 4);
}

TEST(TomlKeyDepth, TextsWithoutAnEndEnd) {
  for (const std::string text :
       {"\"", "'", "\"\"\"", "'''", "\"\\", "a = \"x", "#", "#.", "'''x''"})
    EXPECT_EQ(deepest_key(text).parts, 0) << text;
}

TEST(TomlKeyDepth, AKeyOfManyThousandPartsIsRefused) {
  const TemporaryFolder folder;
  std::string key = "a";
  for (int i = 0; i < 200'000; ++i) key += ".a";
  for (const std::string& text :
       {"b = 1\n" + key + " = 1", "b = 1\n[" + key + "]", "b = 1\nc = { " + key + " = 1 }"}) {
    try {
      read_toml(folder.file("deep.toml", text));
      ADD_FAILURE() << "read";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("deep.toml:2: a key has 20000"), std::string::npos)
          << error.what();
    }
  }
  const std::string begin = "{ " + key.substr(0, 199) + " = ";
  std::string nested, ends;  // no key of it has many parts
  for (int i = 0; i < 255; ++i) {
    nested += begin;
    ends += " }";
  }
  nested += "1" + ends;
  EXPECT_THROW(read_toml(folder.file("deep.toml", "a = " + nested)), InputError);
  EXPECT_NO_THROW(parse_toml_value(nested, "v", {}));
  EXPECT_NO_THROW(parse_toml_value("{ " + key + " = 1 }", "v", {}));  // a text that is no TOML
}

}  // namespace
}  // namespace articular::sim
