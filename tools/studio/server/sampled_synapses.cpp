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

/// The means of what is added to the blocks of a matrix.
class Means {
  public:
    Means(Side sources, Side targets)
        : sources_(sources),
          targets_(targets),
          sums_(sources.blocks() * targets.blocks()),
          n_(sums_.size()) {}
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

class Matrix : public StreamSource {
  public:
    Matrix(const engine::Layout& layout, int connection)
        : sources_(layout.groups[layout.connections[connection].source].shape.cells),
          targets_(layout.groups[layout.connections[connection].target].shape.cells) {}
    std::uint32_t rows() const override { return static_cast<std::uint32_t>(targets_.blocks()); }
    std::uint32_t columns() const override { return static_cast<std::uint32_t>(sources_.blocks()); }

  protected:
    Side sources_, targets_;
};

/// The present values of a state of the synapses.
class States final : public Matrix {
  public:
    States(const engine::Layout& layout, observe::Source mean)
        : Matrix(layout, mean.column.connection), source_(std::move(mean)) {}
    std::string label() const override { return source_.what().label; }
    void declare(engine::Demand& demand) const override { source_.declare(demand); }
    void read(Run& run, std::span<double> out) const override {
        const auto& now = run.simulation();
        const int connection = source_.column.connection;
        const auto pre = now.synapse_sources(connection), post = now.synapse_targets(connection);
        const ConstColumn numbers = now.synapse_state(connection, source_.column.state);
        Means means(sources_, targets_);
        for (std::size_t i = 0; i < pre.size(); ++i)
            means.add(pre[i], post[i], numbers[static_cast<Index>(i)]);
        means.write(out);
    }

  private:
    observe::Source source_;
};

/// The numbers of <Weights>, which do not change.
class FixedWeights final : public Matrix {
  public:
    FixedWeights(const engine::Layout& layout, int connection, const model::Weights& weights)
        : Matrix(layout, connection), means_(rows() * std::size_t{columns()}) {
        const Array& array = *weights.array.array;
        Means means(sources_, targets_);
        const auto sources = static_cast<std::size_t>(sources_.cells);
        std::vector<double> row(array.columns());
        for (std::size_t r = 0; r < array.rows(); ++r) {
            array.copy(r, 1, row.data());
            for (std::size_t k = 0; k < row.size() && !weights.is_list; ++k)
                if (const std::size_t at = r * row.size() + k; !std::isnan(row[k]))  // of a vector, too
                    means.add(static_cast<int>(at % sources), static_cast<int>(at / sources), row[k]);
            if (weights.is_list) means.add(static_cast<int>(row[0]), static_cast<int>(row[1]), row[2]);
        }
        means.write(means_);
    }
    std::string label() const override { return "Weight"; }
    void read(Run&, std::span<double> out) const override { std::ranges::copy(means_, out.begin()); }

  private:
    std::vector<double> means_;
};

}  // namespace

std::unique_ptr<StreamSource> sampled_synapses(Run& run, std::string_view text) {
    const auto& layout = run.layout();
    if (const auto found = model::items_named(layout.connections, text); found.size() == 1) {
        const auto& all = run.system().connections;
        const auto it = std::ranges::find(all, layout.connections[found.front()].id, &model::Connection::id);
        const auto* weights = it == all.end() ? nullptr : std::get_if<model::Weights>(&it->pattern);
        if (!weights || !weights->array)
            throw InputError(fmt::format("connection '{}' has no weights of its synapses in the file", text));
        return std::make_unique<FixedWeights>(layout, found.front(), *weights);
    }
    Diagnostics diagnostics;
    auto source = observe::find_source(layout, fmt::format("mean({})", text), "subscribe", diagnostics);
    throw_errors(diagnostics);
    if (source->column.connection < 0)
        throw InputError(fmt::format("'{}' names a group, and only synapses are sampled", text));
    return std::make_unique<States>(layout, std::move(*source));
}

}  // namespace forage::studio
