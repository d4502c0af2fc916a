#include "tools/studio/server/sampled_synapses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "core/model/lookup.h"
#include "core/observe/source.h"

namespace forage::studio {
namespace {

constexpr int max_blocks = 256;  ///< to either side

/// The cells of a group, joined to blocks.
struct Side {
    explicit Side(int n) : cells(n), cells_per_block((n + max_blocks - 1) / max_blocks) {}
    int cells, cells_per_block;
    std::size_t blocks() const {
        return static_cast<std::size_t>((cells + cells_per_block - 1) / cells_per_block);
    }
    std::size_t block_of(int cell) const { return static_cast<std::size_t>(cell / cells_per_block); }
};

/// A matrix for the synapses of a connection: the means of what is added to its blocks.
class Matrix {
  public:
    Matrix(const engine::Layout& layout, int connection)
        : sources_(layout.groups[layout.connections[connection].source].shape.cells),
          targets_(layout.groups[layout.connections[connection].target].shape.cells),
          sums_(sources_.blocks() * targets_.blocks()),
          n_(sums_.size()) {}
    std::uint32_t rows() const { return static_cast<std::uint32_t>(targets_.blocks()); }
    std::uint32_t columns() const { return static_cast<std::uint32_t>(sources_.blocks()); }
    std::size_t source_cells() const { return static_cast<std::size_t>(sources_.cells); }
    void add(int source, int target, double v) {
        const auto at = targets_.block_of(target) * sources_.blocks() + sources_.block_of(source);
        sums_[at] += v, ++n_[at];
    }
    void write(std::span<double> out) const {
        for (std::size_t i = 0; i < sums_.size(); ++i)
            out[i] = n_[i] > 0 ? sums_[i] / n_[i] : std::numeric_limits<double>::quiet_NaN();
    }

  private:
    Side sources_, targets_;
    std::vector<double> sums_, n_;
};

/// The present values of a state of the synapses.
StreamSource state_source(const engine::Layout& layout, const observe::Source& mean) {
    const Matrix empty(layout, mean.column.connection);
    StreamSource out{empty.rows(), empty.columns(), mean.what().label};
    mean.declare(out.demand);
    out.read = [empty, column = mean.column](Run& run, std::span<double> numbers) {
        const auto& now = run.simulation();
        const auto pre = now.synapse_sources(column.connection),
                   post = now.synapse_targets(column.connection);
        const ConstColumn values = now.synapse_state(column.connection, column.state);
        Matrix means = empty;
        for (std::size_t i = 0; i < pre.size(); ++i)
            means.add(pre[i], post[i], values[static_cast<Index>(i)]);
        means.write(numbers);
    };
    return out;
}

/// The numbers of <Weights>, which do not change.
StreamSource weight_source(const engine::Layout& layout, int connection, const model::Weights& weights) {
    Matrix means(layout, connection);
    const Array& array = *weights.array.array;
    const auto sources = means.source_cells();
    std::vector<double> row(array.columns());
    for (std::size_t r = 0; r < array.rows(); ++r) {
        array.copy(r, 1, row.data());
        for (std::size_t k = 0; k < row.size() && !weights.is_list; ++k)
            if (const std::size_t at = r * row.size() + k; !std::isnan(row[k]))  // of a vector, too
                means.add(static_cast<int>(at % sources), static_cast<int>(at / sources), row[k]);
        if (weights.is_list) means.add(static_cast<int>(row[0]), static_cast<int>(row[1]), row[2]);
    }
    return {means.rows(), means.columns(), "Weight",
            [means](Run&, std::span<double> out) { means.write(out); }};
}

}  // namespace

StreamSource sampled_synapses(Run& run, std::string_view text) {
    const auto& layout = run.layout();
    if (const auto found = model::items_named(layout.connections, text); found.size() == 1) {
        const auto& all = run.system().connections;
        const auto it = std::ranges::find(all, layout.connections[found.front()].id, &model::Connection::id);
        const auto* weights = it == all.end() ? nullptr : std::get_if<model::Weights>(&it->pattern);
        if (!weights || !weights->array)
            throw InputError(fmt::format("connection '{}' has no weights of its synapses in the file", text));
        return weight_source(layout, found.front(), *weights);
    }
    Diagnostics diagnostics;
    auto source = observe::find_source(layout, fmt::format("mean({})", text), "subscribe", diagnostics);
    throw_errors(diagnostics);
    if (source->column.connection < 0)
        throw InputError(fmt::format("'{}' names a group, and only synapses are sampled", text));
    return state_source(layout, *source);
}

}  // namespace forage::studio
