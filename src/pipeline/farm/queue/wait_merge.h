// pipeline/farm/queue/wait_merge.h - waits for the lightmaps of a plan that a queue has.
#pragma once

#include "pipeline/farm/queue/plan_jobs.h"

namespace rnmbake {

struct WaitPauses {
  double files = 1;       // seconds between two looks for new results
  double queue = 30;      // between two questions to Slurm, once it has run for that long
  double until_sure = 5;  // before it is asked again where it has no job any more
};

/// Shows progress, and names objects that fail as they do, until the merge has ended; returns its exit code.
/// The files are the truth. Slurm is asked whether it has the jobs still; where it has none and there is no
/// merge, throws Error(io), or what became of them. Throws Interrupted.
int wait_for_merge(const FarmPlan& plan, const PlanJobs& jobs, const Slurm& slurm,
                   const WaitPauses& pauses = {});

}  // namespace rnmbake
