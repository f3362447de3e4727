#include "sim/base/append_file.hpp"

#include <gtest/gtest.h>

#include "sim/base/error.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::append_file_test {

/// What opening at an extent says against it.
std::string refusal(const std::filesystem::path& path, const FileExtent& extent) {
  try {
    const AppendFile file(path, extent);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(AppendFile, GrowsAtItsEndAndMovesItsClosing) {
  const TemporaryFolder folder;
  const auto path = folder.file("f", "of an earlier run, and longer than all that comes");
  AppendFile file(path);
  file.append("head\n", "end\n");
  EXPECT_EQ(content(path), "head\nend\n");
  file.append("first\n", "end\n");
  file.append("second\n", "end\n");
  EXPECT_EQ(content(path), "head\nfirst\nsecond\nend\n");
  EXPECT_EQ(file.extent().bytes, std::string("head\nfirst\nsecond\n").size());
}

TEST(AppendFile, GoesOnWhereACheckpointKnowsItAndCutsTheRest) {
  const TemporaryFolder folder;
  FileExtent known;
  {
    AppendFile file(folder / "f");
    file.append("one\n");
    file.append("two\n", "</closing>\n");
    known = file.extent();
    file.append("three\n");
    file.append("fo");  // a full disk, a killed run
  }
  const std::string left = content(folder / "f");
  AppendFile file(folder / "f", known);
  EXPECT_EQ(content(folder / "f"), left);  // nothing is lost by looking
  file.sync();
  EXPECT_EQ(content(folder / "f"), "one\ntwo\n");
  file.append("3\n");
  EXPECT_EQ(content(folder / "f"), "one\ntwo\n3\n");
  // As if it had never been closed.
  AppendFile whole(folder / "g");
  whole.append("one\ntwo\n3\n");
  EXPECT_EQ(file.extent(), whole.extent());
}

TEST(AppendFile, WhatWasEditedCutOrDeletedIsRefusedAndLeftAsItIs) {
  const TemporaryFolder folder;
  FileExtent known;
  {
    AppendFile file(folder / "f");
    file.append("time,force\n0,1.5\n1,2.5\n");
    known = file.extent();
  }
  for (const std::string text : {"time,force\n0,1.5\n1,2.6\n", "time,force\n0,1.5\n", ""}) {
    folder.file("f", text);
    EXPECT_NE(refusal(folder / "f", known).find("does not begin with the 23 bytes"),
              std::string::npos)
        << text;
    EXPECT_EQ(content(folder / "f"), text);
  }
  std::filesystem::remove(folder / "f");
  EXPECT_NE(refusal(folder / "f", known), "");
  EXPECT_FALSE(std::filesystem::exists(folder / "f"));
}

TEST(AppendFile, WritesThroughNoSymbolicLink) {
  const TemporaryFolder folder;
  folder.file("target", "mine");
  std::filesystem::create_symlink("target", folder / "f");
  EXPECT_THROW(AppendFile(folder / "f"), SystemError);
  EXPECT_THROW(AppendFile(folder / "f", FileExtent{}), SystemError);
  EXPECT_EQ(content(folder / "target"), "mine");
}

TEST(AppendFile, AFullDiskIsASystemErrorThatNamesTheFile) {
  AppendFile file("/dev/full");
  try {
    file.append("text");
    ADD_FAILURE();
  } catch (const SystemError& error) {
    EXPECT_STREQ(error.what(), "/dev/full: can't be written: No space left on device");
  }
  EXPECT_EQ(file.extent(), FileExtent{});
}

}  // namespace articular::sim::append_file_test
