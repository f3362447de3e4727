// The model of a disk itself: what it keeps, and what it may lose.
#include "tests/faults/power_cut.hpp"

#include <gtest/gtest.h>

#include <map>

#include "tests/sim/support/temporary_folder.hpp"

namespace articular::faults {
namespace {

namespace fs = std::filesystem;
using Kind = Call::Kind;

/// `a` is written as `a.part`, synced if so, and renamed.
std::vector<Call> atomic_write(const fs::path& folder, bool is_synced) {
  const std::string part = folder / "a.part", name = folder / "a";
  std::vector<Call> calls = {{Kind::OpenEmpty, 1, 0, part, "", ""},
                             {Kind::Write, 1, 0, "", "", "text"}};
  if (is_synced) calls.push_back({Kind::Sync, 1, 0, "", "", ""});
  calls.push_back({Kind::Rename, -1, 0, part, name, ""});
  return calls;
}

class PowerCuts : public ::testing::Test {
 protected:
  PowerCuts() { fs::create_directory(folder_ / "before"); }

  fs::path after(const std::vector<Call>& calls, const PowerCut& cut) {
    fs::remove_all(folder_ / "after");
    cut_power(folder_ / "before", "/disk", calls, cut, random_, folder_ / "after");
    return folder_ / "after";
  }

  const TemporaryFolder folder_;
  std::mt19937 random_{1};
};

const PowerCut kNothing = {"", Survives::Nothing, Survives::Nothing};
const PowerCut kNames = {"", Survives::All, Survives::Nothing};
const PowerCut kAll = {"", Survives::All, Survives::All};
const PowerCut kTorn = {"", Survives::All, Survives::Torn};

TEST_F(PowerCuts, ARenameMayComeBeforeDataThatWasNotSynced) {
  EXPECT_EQ(content(after(atomic_write("/disk", false), kNames) / "a"), "");
  EXPECT_EQ(content(after(atomic_write("/disk", true), kNames) / "a"), "text");
  EXPECT_FALSE(fs::exists(after(atomic_write("/disk", true), kNames) / "a.part"));
}

TEST_F(PowerCuts, ANameLastsOnceItsFolderIsSynced) {
  std::vector<Call> calls = atomic_write("/disk", true);
  EXPECT_FALSE(fs::exists(after(calls, kNothing) / "a"));
  calls.push_back({Kind::Open, 2, 0, "/disk", "", ""});
  calls.push_back({Kind::Sync, 2, 0, "", "", ""});
  EXPECT_EQ(content(after(calls, kNothing) / "a"), "text");
}

TEST_F(PowerCuts, WhatWasThereBeforeStaysUntilItsEndIsSynced) {
  std::ofstream(folder_ / "before/a") << "old text";
  std::vector<Call> calls = {{Kind::Open, 1, 0, "/disk/a", "", ""},
                             {Kind::Cut, 1, 3, "", "", ""},
                             {Kind::Write, 1, 3, "", "", "er"}};
  EXPECT_EQ(content(after(calls, kNothing) / "a"), "old text");
  EXPECT_EQ(content(after(calls, kAll) / "a"), "older");
  EXPECT_EQ(content(after(calls, kTorn) / "a"), std::string("olde\0", 5));
  calls.push_back({Kind::Sync, 1, 0, "", "", ""});
  EXPECT_EQ(content(after(calls, kNothing) / "a"), "older");
  calls.push_back({Kind::Remove, -1, 0, "/disk/a", "", ""});
  EXPECT_EQ(content(after(calls, kNothing) / "a"), "older");
  EXPECT_FALSE(fs::exists(after(calls, kAll) / "a"));
}

TEST_F(PowerCuts, BothOfTwoWritesMayBeLostAloneWhereTheOrderIsFree) {
  const std::vector<Call> calls = {{Kind::Open, 1, 0, "/disk/a", "", ""},
                                   {Kind::Write, 1, 0, "", "", "1"},
                                   {Kind::Write, 1, 1, "", "", "2"}};
  std::map<std::string, int> found;
  for (int i = 0; i < 100; ++i)
    ++found[content(after(calls, {"", Survives::All, Survives::Any}) / "a")];
  EXPECT_EQ(found.size(), 4U);
  found.clear();
  for (int i = 0; i < 100; ++i)
    ++found[content(after(calls, {"", Survives::All, Survives::Beginning}) / "a")];
  EXPECT_EQ(found.size(), 3U);
  EXPECT_FALSE(found.contains(std::string("\0002", 2)));
}

TEST_F(PowerCuts, FoldersAreMadeWithWhatIsInThem) {
  std::vector<Call> calls = atomic_write("/disk/sub", true);
  calls.insert(calls.begin(), {Kind::MakeFolder, -1, 0, "/disk/sub", "", ""});
  EXPECT_EQ(content(after(calls, kAll) / "sub/a"), "text");
  EXPECT_FALSE(fs::exists(after(calls, kNothing) / "sub"));
}

}  // namespace
}  // namespace articular::faults
