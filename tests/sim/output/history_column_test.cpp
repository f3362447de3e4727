#include "sim/output/history_column.hpp"

#include <gtest/gtest.h>

namespace articular::sim {

TEST(HistoryColumn, IsNameAndUnit) {
  EXPECT_EQ(history_column("incisor.position.z [mm]"), (HistoryColumn{"incisor.position.z", "mm"}));
  EXPECT_EQ(history_column(" a [b].moment [N m]\r"), (HistoryColumn{"a [b].moment", "N m"}));
  EXPECT_EQ(history_column("plain"), (HistoryColumn{"plain", ""}));
}

}  // namespace articular::sim
