// The run of a session, its past and its pace.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/hit_counts.h"
#include "core/observe/recorder.h"
#include "core/run/run_spec.h"
#include "core/run/stop_condition.h"
#include "tools/studio/server/course.h"
#include "tools/studio/server/equivalents.h"
#include "tools/studio/server/pace.h"

namespace forage::studio {

/// How a page wants to record.
struct SamplerRequest {
    std::string file, mode;
    std::vector<std::string> sources;
    std::uint64_t every = 1;
    std::optional<std::uint64_t> cycles;
};

/// A recording of a page.
struct Sampler {
    Sampled what;
    std::uint64_t rows = 0;
    std::optional<std::uint64_t> left;  ///< cycles
    std::optional<observe::Recorder> recorder;
};

/// A second run from the same past, in step with the run. It repeats what the run did, and begins as the run
/// began, so that the past alone reproduces it.
struct Reference : Course {
    std::uint64_t from = 0;  ///< the cycle since which they may differ
};

struct LiveRun : Course {
    RunInput begun;     ///< with the parameters of the last stop
    std::string files;  ///< digest of the files of system and world, when they were read
    std::optional<Reference> reference;
    Pace pace;
    std::string failed;  ///< why a cycle could not be computed
    std::uint32_t epoch = 1;
    std::uint64_t version = 0;
    /// What pauses the run.
    struct PauseCondition {
        RunLength length;
        StopCondition condition;
        StopOrigin since;
    };
    std::optional<PauseCondition> pause_when;
    /// The hits among the finished trials of the first robot, and the course of the run that they are of.
    struct CountedHits {
        HitCounts counts;
        const Run* run = nullptr;
        std::uint32_t epoch = 0;
    };
    mutable CountedHits counted_hits;
    std::optional<Sampler> sampler;
    std::optional<SamplerRequest> waiting_sampler;  ///< that begins with the run
    bool sampled = false;                           ///< whether it has begun in this run
};

}  // namespace forage::studio
