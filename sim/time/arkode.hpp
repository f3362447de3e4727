#pragma once

#include <arkode/arkode_arkstep.h>

#include "sim/base/sundials.hpp"

/// ARKODE's objects with owners.
namespace articular::sim::sundials {

struct FreeArkode {
  void operator()(void* memory) const { ARKStepFree(&memory); }
};
struct FreeTable {
  void operator()(ARKodeButcherTable table) const { ARKodeButcherTable_Free(table); }
};
using Arkode = Owned<void*, FreeArkode>;
using ButcherTable = Owned<ARKodeButcherTable, FreeTable>;

}  // namespace articular::sim::sundials
