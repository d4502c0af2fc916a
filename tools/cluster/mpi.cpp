// forage-mpi: executes an experiment with MPI. Rank 0 hands out blocks of runs, the other ranks execute them,
// and rank 0 writes the tables at the end.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <mpi.h>

#include "core/base/print.h"
#include "core/run/experiment/tables.h"
#include "tools/api/experiment/experiment.h"

namespace forage::cluster {
namespace {

enum Tag { ask, give };

struct Options {
    std::string file, directory;
    std::vector<std::string> plugins;
    bool quiet = false;
};

void print_failures(const PartOutcome& out) {
    for (const auto& [run, reason] : out.failures) print(stderr, "error: run '{}': {}\n", run, reason);
}

/// Hands out blocks, which become smaller towards the end, until all ranks have got an empty one. Between the
/// questions it sleeps, so it takes no core.
void hand_out(const std::vector<std::size_t>& open, int workers, bool quiet) {
    std::size_t next = 0, shown = 0;
    for (int left = workers; left > 0;) {
        int asked = 0;
        MPI_Status from;
        MPI_Iprobe(MPI_ANY_SOURCE, ask, MPI_COMM_WORLD, &asked, &from);
        if (!asked) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            continue;
        }
        MPI_Recv(nullptr, 0, MPI_BYTE, from.MPI_SOURCE, ask, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        const std::size_t rest = open.size() - next;
        const std::size_t count =
            std::min(rest, std::clamp<std::size_t>(rest / (4 * static_cast<std::size_t>(workers)), 1, 1000));
        const std::vector<std::uint64_t> block(open.begin() + static_cast<std::ptrdiff_t>(next),
                                               open.begin() + static_cast<std::ptrdiff_t>(next + count));
        MPI_Send(block.data(), static_cast<int>(block.size()), MPI_UINT64_T, from.MPI_SOURCE, give,
                 MPI_COMM_WORLD);
        next += count;
        if (count == 0) --left;
        if (!quiet && next * 10 / std::max<std::size_t>(open.size(), 1) > shown) {
            shown = next * 10 / open.size();
            print(stderr, "{}/{} runs handed out\n", next, open.size());
        }
    }
}

/// Tells all ranks from rank 0 which runs the round has. Returns false after the last round.
bool begin_round(PreparedExperiment& e, bool last, int rank) {
    std::vector<std::uint64_t> seeds(e.runs.combinations());
    for (std::size_t c = 0; c < seeds.size(); ++c) seeds[c] = last ? 0 : e.runs.seeds(c);
    MPI_Bcast(seeds.data(), static_cast<int>(seeds.size()), MPI_UINT64_T, 0, MPI_COMM_WORLD);
    if (rank != 0) e.runs = e.runs.with_seeds({seeds.begin(), seeds.end()});
    return seeds.front() > 0;
}

/// Executes blocks of rank 0 until it gives an empty one.
void work(const PreparedExperiment& e, PartFile& file) {
    for (;;) {
        MPI_Send(nullptr, 0, MPI_BYTE, 0, ask, MPI_COMM_WORLD);
        MPI_Status from;
        MPI_Probe(0, give, MPI_COMM_WORLD, &from);
        int count = 0;
        MPI_Get_count(&from, MPI_UINT64_T, &count);
        std::vector<std::uint64_t> block(static_cast<std::size_t>(count));
        MPI_Recv(block.data(), count, MPI_UINT64_T, 0, give, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        if (block.empty()) return;
        print_failures(run_part(e, file, {block.begin(), block.end()}, 1, {}));
    }
}

std::vector<std::size_t> runs_without_results(const PartResults& found) {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < found.results.size(); ++i)
        if (!found.results[i]) out.push_back(i);
    return out;
}

int execute(const Options& o, int rank, int ranks) {
    Diagnostics diagnostics;
    auto e = prepare_part(o.file, o.directory, o.plugins, diagnostics);
    if (rank == 0 && (diagnostics.failed() || !o.quiet)) print(stderr, "{}", format(diagnostics));
    // All ranks stop when one of them cannot read the files.
    int fine = e.has_value(), all_fine = 0;
    MPI_Allreduce(&fine, &all_fine, 1, MPI_INT, MPI_LAND, MPI_COMM_WORLD);
    if (!all_fine) {
        if (rank != 0 && !fine) print(stderr, "rank {} cannot read the experiment\n", rank);
        return 2;
    }
    PartFile file(e->directory, fmt::format("mpi-{}", rank));
    if (rank != 0) {
        while (begin_round(*e, false, rank)) {
            work(*e, file);
            MPI_Barrier(MPI_COMM_WORLD);  // all results of the round are written
        }
        return 0;
    }
    for (auto open = open_runs(read_results(*e)); !open.empty();
         open = runs_without_results(read_results(*e))) {
        begin_round(*e, false, rank);
        if (ranks > 1)
            hand_out(open, ranks - 1, o.quiet);
        else
            print_failures(run_part(*e, file, open, 1, {}));
        MPI_Barrier(MPI_COMM_WORLD);
    }
    begin_round(*e, true, rank);
    const auto results = merge(*e, diagnostics);
    if (!results) {
        print(stderr, "{}", format(diagnostics));
        return 1;
    }
    const bool failed = std::ranges::any_of(*results, [](const auto& r) { return !r.failure.empty(); });
    if (!o.quiet)
        print("{}: {} runs\n{}  written: {}, {}\n", o.file, e->runs.size(),
              summary_text(e->experiment, e->runs, *results), e->results_file(), e->summary_file());
    return failed;
}

int parse_and_execute(int argc, char** argv, int rank, int ranks) {
    Options o;
    CLI::App app(
        "Executes an experiment with MPI, one run per rank at a time. Rank 0 hands out the runs and "
        "needs no core.\nExample:\n  mpirun -n 65 forage-mpi systems/light_threshold.xml");
    app.set_version_flag("--version", "forage " FORAGE_VERSION, "Print the version");
    app.add_option("FILE", o.file, "Experiment file (.xml)")->required()->option_text(" ");
    app.add_option("-o,--output", o.directory, "Directory for results [forage-out/ and FILE's name]")
        ->option_text("DIR");
    app.add_option("--plugin", o.plugins,
                   "Plugin with more types (.so), or a folder of plugins; may be repeated")
        ->allow_extra_args(false)
        ->option_text("PATH");
    app.add_flag("-q,--quiet", o.quiet, "Print errors only");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool fine = error.get_exit_code() == 0;  // a call for help
        if (rank == 0 && fine) app.exit(error);
        if (rank == 0 && !fine) print(stderr, "error: {}\n  hint: forage-mpi --help\n", error.what());
        return fine ? 0 : 2;
    }
    return execute(o, rank, ranks);
}

}  // namespace
}  // namespace forage::cluster

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank = 0, ranks = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    int status = 1;
    try {
        status = forage::cluster::parse_and_execute(argc, argv, rank, ranks);
    } catch (const std::exception& e) {
        forage::print(stderr, "error: rank {}: {}\n", rank, e.what());
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    MPI_Finalize();
    return status;
}
