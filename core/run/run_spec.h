// The description of a run, as plain values.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/model/experiment.h"
#include "core/run/udp_socket.h"

namespace forage {

/// The input of a run: files and settings.
struct RunInput {
    std::string system, world;                ///< paths; no world when empty
    std::vector<std::string> more;            ///< further systems that run together with the first
    std::vector<model::Expression> settings;  ///< "Process/Group.parameter=value"
    std::vector<model::Expression> robots;    ///< "NAME=NAME": the system's robot, the world's robot
    std::string replay;                       ///< table for moduleReplay; none when empty
    /// Shared objects and folders of them, in addition to those that are found.
    std::vector<std::string> plugins;
    bool lenient = false;    ///< whether mistakes that the original accepts are warnings, not errors
    std::uint64_t seed = 1;  ///< decides everything random
    /// Seconds of the world per second of the clock. Empty for the world's own rate.
    std::optional<double> real_time_factor;
    bool noise = true;          ///< whether motors and sensors are noisy
    bool sensor_rates = false;  ///< scans and pictures at the rates of the world's files
    int latency = 0;            ///< cycles by which sensed values arrive later
    bool game = false;          ///< play the challenge's game
    /// The text of `system` when it is not a file but a system that was built in code; otherwise empty.
    std::string text = {};
    /// The text of `world` when it is not that of the file; otherwise empty.
    std::string world_text = {};
    /// For a run that is resumed, the digests of its files. A checkpoint names `plugins` then, not the user:
    /// those in folders that are not trusted are not loaded, and those that have changed are errors.
    std::optional<std::map<std::string, std::string>> resumed_files = {};
};

/// The options of all recordings of a run.
struct RecordOptions {
    std::string format = "csv";          ///< csv, npy, npz, h5 or dat, for recordings without a file name
    std::uint64_t from = 0;              ///< the first cycle
    std::optional<std::uint64_t> until;  ///< the last cycle
    bool mean = false;                   ///< whether a row is the mean of the cycles up to the next row
};

/// The length of a run in cycles, seconds or trials; 60 seconds when none of them is given. A condition may
/// end it earlier.
struct RunLength {
    std::optional<std::uint64_t> cycles = {};
    std::optional<double> seconds = {};        ///< length in seconds of the world
    std::optional<std::uint64_t> trials = {};  ///< length in trials of the first robot
    double trial_timeout = 300;                ///< the run stops when a trial takes longer, s of the world
    model::Expression until = {};              ///< a condition; none when empty
    Location at = {};      ///< where the length is given; without a file, the command line or code
    bool in_code = false;  ///< whether a program gives the length, which then has no options
};

/// The interval between checkpoints.
struct CheckpointInterval {
    double amount = 0;        ///< above 0
    bool in_seconds = false;  ///< whether `amount` is in seconds of the world instead of cycles
};

/// Averages of groups that a run sends while it lasts (broadcaster.h).
struct BroadcastSpec {
    std::optional<Endpoint> to;  ///< none when empty
    int interval_ms = 500;       ///< time between two datagrams, ms of the clock
    std::vector<model::Expression>
        sources;  ///< "Process/Group:state"; the activities of all groups when empty
};

/// What a run does when a number becomes NaN or infinite. The search covers every group that the run
/// computes.
enum class OnNan { warn, stop, ignore };

/// A run as the command line or an experiment describes it. docs/reference/expressions.md explains the texts.
struct RunSpec {
    RunInput input;
    RunLength length;
    RecordOptions record;
    std::vector<model::RecordingSpec> recordings;
    std::vector<model::Expression> plots;
    std::string plot_format = "png";              ///< png, svg or pdf
    std::vector<model::ScheduledChange> changes;  ///< changes of parameters and of the world
    std::vector<model::ManipulationSpec> manipulations;
    std::vector<model::Measure> measures;
    bool paths = true;                            ///< whether the robots' paths are recorded
    std::string video;                            ///< .gif, .mp4 or .png file of a film; none when empty
    std::vector<model::Expression> video_groups;  ///< sources that the film shows beside the world
    int threads = 1;  ///< largest number of threads; the results do not depend on it
    OnNan on_nan = OnNan::warn;
    bool digest = false;    ///< whether everything is computed, for a digest of the final state
    bool explain = false;   ///< whether statistics of all groups are collected, to explain what they did
    std::string directory;  ///< directory of the results; none when empty
    /// Whether to start even if the directory holds the checkpoint of an unfinished run.
    bool discard_checkpoint = false;
    std::optional<CheckpointInterval> checkpoint_every;
    std::optional<Endpoint>
        remote;  ///< where the run receives commands (remote_control.h); nowhere when empty
    BroadcastSpec broadcast;
    std::vector<std::string> arguments;  ///< arguments of the command line, which checkpoints keep
    /// Those words of the command line that decide the results; empty when no command line began the run.
    std::vector<std::string> command;
    std::string bundle;  ///< archive for everything that repeats the run (bundle.h); none when empty
};

}  // namespace forage
