#include "core/run/experiment/plan.h"

#include <algorithm>
#include <filesystem>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "core/base/digest.h"
#include "core/base/output_files.h"
#include "core/base/sequence.h"
#include "core/model/lookup.h"

namespace forage {
namespace {

/// The part of the spec that all runs share.
RunSpec common(const model::Experiment& e) {
    RunSpec o;
    o.input.world = e.world, o.input.settings = e.settings, o.input.robots = e.robots;
    for (const auto& system : e.systems) o.input.more.push_back(system.text);
    o.input.real_time_factor = e.real_time_factor, o.input.noise = e.noise;
    o.length = {e.cycles, e.seconds, e.trials, e.trial_timeout, e.until, e.length_at};
    o.length.in_code = !e.length_at.file;
    o.recordings = e.recordings, o.changes = e.changes, o.measures = e.measures;
    o.manipulations = e.manipulations, o.plots = e.plots;
    o.paths = std::ranges::any_of(
        e.plots, [](const auto& plot) { return model::trim(plot.text).starts_with("trajectory"); });
    return o;
}

constexpr std::size_t max_name = 200;  ///< bytes of the part of a folder's name that tells the values

/// "eta" of "Adaptive.eta".
std::string short_name(const std::string& parameter) {
    return parameter.substr(parameter.rfind('.') + 1);  // npos + 1 is 0
}

}  // namespace

RunPlan::RunPlan(const model::Experiment& e, std::string directory, const std::vector<std::string>& plugins)
    : directory_(std::move(directory)), common_(common(e)), sweeps_(e.sweeps), seeds_(e.seeds) {
    common_.input.plugins = plugins;
    const bool swept = std::ranges::any_of(sweeps_, [](const auto& s) { return !s.files.empty(); });
    if (!swept && !e.systems.empty()) {
        common_.input.system = common_.input.more.front();
        common_.input.more.erase(common_.input.more.begin());
    }
    for (const auto& sweep : sweeps_)
        if (sweep.axis == sizes_.size()) sizes_.push_back(sweep.values.size());
    strides_.resize(sizes_.size());
    combinations_ = 1;
    for (std::size_t i = sizes_.size(); i-- > 0; combinations_ *= sizes_[i]) strides_[i] = combinations_;
    std::unordered_map<std::string, std::size_t> names;
    for (std::size_t c = 0; c < combinations_; ++c)
        if (const std::size_t earlier = names[combination_name(c)]++; earlier > 0) repeated_[c] = earlier;
}

RunPlan RunPlan::with_seeds(const std::vector<std::size_t>& counts) const {
    RunPlan out = *this;
    out.first_.assign(1, 0);
    for (const std::size_t count : counts) out.first_.push_back(out.first_.back() + count);
    const std::size_t most = counts.empty() ? 0 : *std::ranges::max_element(counts);
    std::uint64_t last = seeds_.empty() ? 0 : *std::ranges::max_element(seeds_);
    while (out.seeds_.size() < most) out.seeds_.push_back(++last);
    return out;
}

std::size_t RunPlan::combination(std::size_t run) const {
    if (first_.empty()) return run / seeds_.size();
    return static_cast<std::size_t>(std::ranges::upper_bound(first_, run) - first_.begin()) - 1;
}

std::size_t RunPlan::chosen(const model::Sweep& sweep, std::size_t combination) const {
    return combination / strides_[sweep.axis] % sizes_[sweep.axis];
}

std::vector<std::string> RunPlan::values(std::size_t combination) const {
    return collected(sweeps_, [&](const auto& s) { return s.values[chosen(s, combination)].text; });
}

std::string RunPlan::combination_name(std::size_t combination) const {
    std::string out;
    for (const auto& sweep : sweeps_) {
        const auto& value = sweep.values[chosen(sweep, combination)].text;
        const std::string shown = sweep.files.empty() ? value : std::filesystem::path(value).stem().string();
        out += file_name(fmt::format("{}-{}_", short_name(sweep.parameter.text), shown));
    }
    if (out.size() > max_name) {  // names of files have at most 255 bytes
        const std::string whole = digest(out).substr(0, 16);
        std::size_t kept = max_name - whole.size() - 2;
        while ((out[kept] & 0xC0) == 0x80) --kept;  // not within a character of UTF-8
        out = fmt::format("{}_{}_", out.substr(0, kept), whole);
    }
    return out;
}

std::string RunPlan::name(std::size_t run) const {
    const std::size_t combination = this->combination(run);
    const auto own = seeds_.begin() + static_cast<std::ptrdiff_t>(run - first(combination));
    std::string out = fmt::format("{}seed-{}", combination_name(combination), *own);
    auto earlier = static_cast<std::size_t>(std::count(seeds_.begin(), own, *own));
    if (const auto found = repeated_.find(combination); found != repeated_.end())
        earlier += found->second * static_cast<std::size_t>(std::ranges::count(seeds_, *own));
    return earlier > 0 ? fmt::format("{}_{}", out, earlier + 1) : out;
}

const std::string& RunPlan::system(std::size_t combination) const {
    const std::string* out = &common_.input.system;
    for (const auto& sweep : sweeps_)
        if (!sweep.files.empty()) out = &sweep.files[chosen(sweep, combination)];
    return *out;
}

std::vector<model::Expression> RunPlan::settings(std::size_t combination) const {
    std::vector<model::Expression> out;
    for (const auto& sweep : sweeps_)
        if (sweep.files.empty()) {
            const auto& value = sweep.values[chosen(sweep, combination)];
            out.push_back({sweep.parameter.text + "=" + value.text, sweep.parameter.at, value.at});
        }
    return out;
}

const std::string& RunPlan::files(std::size_t combination) const {
    static const std::string none;
    const auto found = files_.find(system(combination));
    return found == files_.end() ? none : found->second;
}

PlannedRun RunPlan::operator[](std::size_t run) const {
    const std::size_t combination = this->combination(run);
    PlannedRun out{name(run), values(combination), files(combination), common_};
    RunInput& input = out.spec.input;
    input.system = system(combination);
    for (auto& setting : settings(combination)) input.settings.push_back(std::move(setting));
    input.seed = seed(run);
    out.spec.directory = directory_ + "/runs/" + out.name;
    return out;
}

}  // namespace forage
