// What users select of a running system, or of a recording of one.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/pattern.h"
#include "core/observe/column.h"

namespace forage::observe {

/// "mean:Process/Group:state(1..3,2)", taken apart: `mean:` for the mean of the cells instead of each, and at
/// the end the cells, (x,y), (x1..x2,y) or (x1..x2,y1..y2), counted from 1.
struct Selection {
    bool mean = false;
    std::string column;
    std::optional<model::Region> region;  ///< empty: the whole group
};
Selection parse_selection(std::string_view text);

/// The numbers of a row: what they are, and of which cells.
struct Recorded {
    std::string name;                    ///< as selected: "Process/Group:state(1..3,2)"
    std::string label;                   ///< of the state: "Membrane potential"
    std::string group_id, group, state;  ///< empty when they are not known
    model::Region cells;                 ///< of a group whose cells have no places: as many, in one row
    int group_width = 1;                 ///< columns of the whole group
    bool numbered = false;               ///< the cells have no places
    bool mean = false;                   ///< one number: the mean of the cells

    std::size_t size() const {
        return mean ? 1 : static_cast<std::size_t>(cells.width) * static_cast<std::size_t>(cells.height);
    }
    /// What the i-th number is called: "x3_y1", "cell3" or "mean".
    std::string cell_name(std::size_t i) const;
};

/// The rows of `what` that belong to `selection`: which numbers to take, and what they are then. Empty when
/// it has not all of these cells.
struct Part {
    std::vector<std::size_t> numbers;  ///< of a mean: those that go into it
    Recorded what;
    /// Takes them out of a row; `out` has what.size() of them.
    void take(std::span<const double> row, std::span<double> out) const;
};
std::optional<Part> part_of(const Recorded& what, const Selection& selection);

/// A selection of the columns of a system.
class Source {
  public:
    const Recorded& what() const { return part_.what; }
    /// The numbers of the running cycle, or of the last one between cycles; `out` has what().size() of them.
    void read(const engine::Simulation& simulation, std::span<double> out) const;
    /// Demands what it reads.
    void declare(engine::Demand& out) const { observe::declare(column_, out); }

  private:
    friend std::optional<Source> find_source(const engine::Layout&, std::string_view, std::string_view,
                                             Diagnostics&, Location);
    ColumnRef column_;
    Part part_;
};

/// The source that `text` names. Reports what is not there; `what` says where the text stands ("--record").
std::optional<Source> find_source(const engine::Layout& layout, std::string_view text, std::string_view what,
                                  Diagnostics& diagnostics, Location at = {});

}  // namespace forage::observe
