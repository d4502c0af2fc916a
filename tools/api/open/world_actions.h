// Changes of the world at times that are known before the run.
#pragma once

#include "core/observe/schedule.h"
#include "core/run/run.h"

namespace forage {

/// Reads "move NAME=X,Y[,HEADING]" and "begin_trial [ROBOT][=START]" for a schedule, with the meaning of the
/// functions of moves.h: places in m, headings in rad, starts from 0. Reports names that the world of this
/// run does not have.
observe::ReadAction actions_on(Run& run);

}  // namespace forage
