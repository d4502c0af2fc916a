#include "core/engine/kernels/forms.h"

#include <numeric>

namespace forage::engine {
namespace {

/// values[i] goes to place[i]; what it was is freed.
template <class T>
std::vector<T> permuted(std::vector<T> values, const std::vector<int>& place) {
    std::vector<T> out(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) out[place[i]] = values[i];
    return out;
}

}  // namespace

ByTarget sort_by_target(connectivity::Synapses s, int targets) {
    ByTarget out;
    out.start.assign(targets + 1, 0);
    for (const int post : s.post) ++out.start[post + 1];
    std::partial_sum(out.start.begin(), out.start.end(), out.start.begin());
    for (double& a : s.attenuation) a = s.reference - a;
    if (std::is_sorted(s.post.begin(), s.post.end())) {
        out.pre = std::move(s.pre), out.delay = std::move(s.delay), out.factor = std::move(s.attenuation);
        return out;
    }
    std::vector<int> next(out.start.begin(), out.start.end() - 1);
    for (int& post : s.post) post = next[post]++;  // now the synapse's place
    out.pre = permuted(std::move(s.pre), s.post);
    out.delay = permuted(std::move(s.delay), s.post);
    out.factor = permuted(std::move(s.attenuation), s.post);
    return out;
}

std::unique_ptr<Kernel> make_kernel(connectivity::Synapses synapses, GroupShape source, GroupShape target,
                                    Forms forms) {
    ByTarget sorted = sort_by_target(std::move(synapses), target.cells);
    if (forms == Forms::fastest) {
        if (auto kernel = make_one_to_one(sorted, source.cells)) return kernel;
        if (auto kernel = make_broadcast(sorted)) return kernel;
        if (auto kernel = make_by_source(sorted, source, target)) return kernel;
        if (auto kernel = make_sliced(sorted, source.cells)) return kernel;
    }
    return make_list(std::move(sorted));
}

std::unique_ptr<Kernel> make_kernel(const connectivity::Regular& regular, int target_cells) {
    const auto& first = regular.taps.front();
    const double factor = regular.reference - first.attenuation;
    if (regular.all_to_all) {
        const auto n = regular.sources.size();
        ByTarget one{{0, static_cast<int>(n)}, regular.sources, {}, {}};
        one.delay.assign(n, first.delay);
        one.factor.assign(n, factor);
        const bool everywhere = std::ssize(regular.targets) == target_cells;
        return make_broadcast(std::move(one), target_cells,
                              everywhere ? std::vector<int>() : regular.targets);
    }
    if (regular.taps.size() == 1 && first.dx == 0 && first.dy == 0)
        return make_one_to_one(target_cells, first.delay, factor);
    return make_window(regular);
}

std::unique_ptr<PlasticKernel> make_plastic(connectivity::Synapses synapses, GroupShape source,
                                            GroupShape target, const SynapseType& type, bool reads_states,
                                            Rows& rows, Forms forms) {
    if (forms == Forms::fastest)
        if (auto kernel = make_plastic_by_source(synapses, source, target, type, reads_states, rows))
            return kernel;
    return make_plastic_list(std::move(synapses), target.cells, type, rows);
}

}  // namespace forage::engine
