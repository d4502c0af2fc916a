#include "core/run/experiment/trials_table.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "core/base/file_bytes.h"
#include "core/base/output_files.h"
#include "core/run/input_error.h"
#include "core/run/result_names.h"
#include "core/run/trial_recorder.h"

namespace forage {
namespace {

/// How many runs are read together. Consecutive runs lie in the files of different parts, so each file is
/// opened once for many runs.
constexpr std::size_t block = 4096;

/// The table of a run with trials; it has a header, also when no trial ended. Reports a table that is missing
/// or empty.
std::string read_table(const std::string& directory, Diagnostics& diagnostics) {
    const std::string path = directory + "/" + trials_file();
    std::string out = file_bytes(path);
    if (out.empty())
        diagnostics.error(
            {}, fmt::format("cannot read the trials of a finished run: '{}' is missing or empty", path),
            fmt::format("remove '{}' and start the experiment again, which repeats this run", directory));
    return out;
}

}  // namespace

void write_trials(const std::string& path, const RunPlan& plan, std::span<const RunResult> results,
                  const PartResults& found) {
    std::filesystem::remove(path);
    std::ofstream out;
    Diagnostics diagnostics;
    for (std::size_t first = 0; first < results.size(); first += block) {
        const std::size_t count = std::min(block, results.size() - first);
        auto tables = read_trials(found, std::span(found.lines).subspan(first, count));
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t run = first + i;
            if (!results[run].failure.empty() || !results[run].trials) continue;
            if (found.lines[run].file == PartResults::no_file)
                tables[i] = read_table(plan[run].spec.directory, diagnostics);
            std::size_t at = tables[i].find('\n') + 1;  // behind the header; npos + 1 is 0
            if (at == 0) continue;
            if (!out.is_open()) out.open(partial(path), std::ios::binary), out << "run," << trial_columns;
            const std::string name = plan.name(run);
            for (std::size_t end; (end = tables[i].find('\n', at)) != std::string::npos; at = end + 1)
                out << name << ',' << std::string_view(tables[i]).substr(at, end + 1 - at);
        }
    }
    if (diagnostics.failed()) {
        out.close();
        std::filesystem::remove(partial(path));
        throw InputError(std::move(diagnostics));
    }
    if (!out.is_open()) return;
    out.close();
    if (!out) throw std::runtime_error(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
    finish(path);
    flush_to_disk(path);
}

}  // namespace forage
