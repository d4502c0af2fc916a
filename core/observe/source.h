// Sources: what users select from a running system or a recording.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/pattern.h"
#include "core/observe/column.h"

namespace forage::observe {

/// The description of the numbers in a row: the state and the cells that they belong to.
struct Recorded {
    std::string name;                    ///< the source: "Process/Group:state(1..3,2)"
    std::string label;                   ///< label of the state: "Membrane potential"
    std::string group_id, group, state;  ///< empty when unknown
    model::Region cells;                 ///< cells without places are one row
    int group_width = 1;                 ///< columns of the whole group
    bool numbered = false;               ///< whether the cells have no places
    std::string_view reduction = {};     ///< "mean" or "max": the row is this one number of the cells
    bool synapses = false;               ///< whether it is a matrix of synapses; unknown in files
    CellNames names = {};                ///< of the whole group's cells

    bool one_number() const { return !reduction.empty(); }
    std::size_t size() const {
        return one_number() ? 1
                            : static_cast<std::size_t>(cells.width) * static_cast<std::size_t>(cells.height);
    }
    /// The name of the i-th number: "x3_y1", "cell3", "mean" or "max".
    std::string cell_name(std::size_t i) const;
    /// What the numbers are, for people: the names of the cells, or "(3, 1)", column and row. Cells of the
    /// same name have both.
    std::vector<std::string> titles() const;
};

/// Some numbers of a row, or their mean or maximum.
struct Part {
    std::vector<std::size_t> numbers;  ///< indices into the row; for one number of cells, of all of them
    Recorded what;
    /// Copies the numbers of the part from a row; `out` has what.size() numbers.
    void take(std::span<const double> row, std::span<double> out) const;
};
/// The part of the rows of `what` that holds the cells of `source`, or one number of them. Empty when a
/// cell is missing.
std::optional<Part> part_of(const Recorded& what, const expression::Source& source);

/// Cells of a column, or one number of them. The synapses of a connection are cells of a matrix that has a
/// column per source cell and a row per target cell, both counted from 1. The number is NaN where there is no
/// synapse, and the sum where several synapses connect the same two cells.
struct Source {
    ColumnRef column;
    Part part;

    const Recorded& what() const { return part.what; }
    /// Reads the numbers of the running cycle, or, between cycles, of the last one; `out` has what().size()
    /// numbers.
    void read(const engine::Simulation& simulation, std::span<double> out) const;
    /// The numbers of the cells, or of the synapses between cells of the range.
    std::vector<double> all(const engine::Simulation& simulation) const;
    /// Demands the column.
    void declare(engine::Demand& out) const { observe::declare(column, out); }
};

/// The source that an expression names. Reports unknown groups, states and cells.
std::optional<Source> find_source(const engine::Layout& layout, const expression::Source& source,
                                  const expression::Context& context);
/// The source that `text` names; `what` begins the messages ("--record").
std::optional<Source> find_source(const engine::Layout& layout, std::string_view text, std::string_view what,
                                  Diagnostics& diagnostics, Location at = {});
/// The part of a column that holds the cells of `source`, or one number of them. Reports cells outside the
/// group.
std::optional<Part> find_part(const engine::Layout& layout, const ColumnRef& column,
                              const expression::Source& source, const expression::Context& context);

}  // namespace forage::observe
