#include "core/run/experiment/trials_table.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/run/trial_recorder.h"

namespace forage {
namespace {

/// How many runs are read together. Consecutive runs lie in the files of different parts, so each file is
/// opened once for many runs.
constexpr std::size_t block = 4096;

std::string text_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

void write_trials(const std::string& path, const RunPlan& plan, std::span<const RunResult> results,
                  const PartResults& found) {
    std::filesystem::remove(path);
    std::ofstream out;
    for (std::size_t first = 0; first < results.size(); first += block) {
        const std::size_t count = std::min(block, results.size() - first);
        auto tables = read_trials(found, std::span(found.lines).subspan(first, count));
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t run = first + i;
            if (!results[run].failure.empty() || !results[run].trials) continue;
            if (found.lines[run].file == PartResults::no_file)
                tables[i] = text_of(plan[run].spec.directory + "/trials.csv");
            std::size_t at = tables[i].find('\n') + 1;  // behind the header; npos + 1 is 0
            if (at == 0) continue;
            if (!out.is_open()) out.open(partial(path), std::ios::binary), out << "run," << trial_columns;
            const std::string name = plan.name(run);
            for (std::size_t end; (end = tables[i].find('\n', at)) != std::string::npos; at = end + 1)
                out << name << ',' << std::string_view(tables[i]).substr(at, end + 1 - at);
        }
    }
    if (!out.is_open()) return;
    out.close();
    if (!out) throw std::runtime_error(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
    finish(path);
    flush_to_disk(path);
}

}  // namespace forage
