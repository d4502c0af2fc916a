#include "core/observe/manipulation_spec.h"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include <fmt/format.h>

#include "core/base/drive_table.h"
#include "core/base/named_file.h"
#include "core/base/number.h"
#include "core/observe/pattern_file.h"

namespace forage::observe {
namespace {

using Spec = model::ManipulationSpec;
using Settings = Manipulation::Settings;

class ManipulationReader {
  public:
    ManipulationReader(const engine::Layout& layout, bool trials, const KnownLength& length,
                       Diagnostics& diagnostics)
        : layout_(layout), trials_(trials), length_(length), diagnostics_(diagnostics) {}

    void add(const Spec& spec) {
        mode_ = Spec::name_of(spec.mode);
        Settings settings;
        settings.mode = spec.mode;
        settings.every = spec.every, settings.step = spec.step, settings.times = spec.times;
        settings.backwards = spec.backwards;
        settings.from = condition(spec.from), settings.until = condition(spec.until);
        if (!spec.table.empty()) return add_table(spec, settings);
        const auto column = manipulated(spec.group);
        if (!column) return;
        settings.group = column->group;
        if (spec.cells.empty())
            add_patterns(spec, std::move(settings));
        else
            add_cells(spec, std::move(settings), *column);
    }

    std::vector<std::unique_ptr<Manipulation>> made() {
        std::ranges::stable_sort(made_, [](const Made& a, const Made& b) {
            return std::pair(a.spec->mode, a.rows.empty()) < std::pair(b.spec->mode, b.rows.empty());
        });
        std::vector<std::unique_ptr<Manipulation>> out;
        for (auto m = made_.begin(); m != made_.end(); ++m) {
            std::ranges::stable_sort(m->rows, {}, &Row::first);
            for (auto& [start, values] : m->rows) {
                m->settings.starts.push_back(start);
                m->settings.patterns.push_back(std::move(values));
            }
            warn_if_never(*m);
            const auto clashes = [&](const Made& earlier) { return of_one_group(earlier, *m); };
            if (const auto other = std::find_if(made_.begin(), m, clashes); other != m)
                report_overlap(*other, *m);
        }
        for (auto& m : made_) {
            auto made = std::make_unique<Manipulation>(std::move(m.settings));
            if (made->settings().mode == Manipulation::Mode::clamp)
                for (auto it = out.rbegin(); it != out.rend(); ++it)
                    if ((*it)->settings().group == made->settings().group) {
                        made->join(**it);
                        break;
                    }
            out.push_back(std::move(made));
        }
        return out;
    }

  private:
    using Row = std::pair<std::int64_t, std::vector<double>>;
    struct Made {
        const Spec* spec;
        Settings settings;
        std::vector<Row> rows;  ///< rows of tables
    };

    std::string what(const Location& at) const { return (at.file ? "" : "--") + mode_; }
    std::optional<Condition> condition(const model::Expression& when) {
        if (when.empty()) return std::nullopt;
        return parse_condition(layout_, trials_, when.text, what(when.at), diagnostics_, when.at);
    }

    void warn_if_never(const Made& m) {
        const auto why = why_never(m.settings, length_);
        if (why.empty()) return;
        const auto& at = m.spec->from.empty() ? m.spec->until.at : m.spec->from.at;
        diagnostics_.warning(at, fmt::format("{}: it never acts: {}", described(*m.spec), why),
                             "cycles and seconds are counted from 0, trials from 1");
    }

    /// "--clamp 'P/A=1'", or "clamp of 'P/A'" in a file
    std::string described(const Spec& spec) const {
        const auto* mode = Spec::name_of(spec.mode);
        if (!spec.text.empty()) return fmt::format("--{} '{}'", mode, spec.text);
        return fmt::format("{} of '{}'", mode, spec.table.empty() ? spec.group.text : spec.table.text);
    }

    bool act_together(const Made& a, const Made& b) const {
        return observe::act_together(a.settings, b.settings,
                                     !a.spec->from.empty() && a.spec->from.text == b.spec->from.text,
                                     length_.seconds_per_cycle);
    }

    /// Whether two clamps, at least one of them of all cells of a group, certainly act together.
    bool of_one_group(const Made& a, const Made& b) const {
        return a.settings.mode == Manipulation::Mode::clamp && b.settings.mode == a.settings.mode &&
               a.settings.group == b.settings.group &&
               (a.settings.cells.empty() || b.settings.cells.empty()) && act_together(a, b);
    }

    static constexpr const char* separate =
        "keep one of them, or give them times that do not overlap: '...; until cycle 10' and '...; from "
        "cycle 10'";

    void report_overlap(const Made& first, const Made& second) {
        const auto all = [](const Made& m) {
            return m.settings.cells.empty() ? "all cells of it" : "cells of it";
        };
        const auto& at = second.spec->table.empty() ? second.spec->group.at : second.spec->table.at;
        diagnostics_.error(
            at,
            fmt::format("{}: group '{}' is clamped twice at the same time: {} sets {}, this one {}",
                        described(*second.spec), layout_.groups[second.settings.group].path,
                        described(*first.spec), all(first), all(second)),
            separate);
    }

    /// The column of a group's activity.
    std::optional<ColumnRef> manipulated(const model::Expression& group) {
        if (names_connection(layout_, {group.text})) {
            diagnostics_.error(
                group.at,
                fmt::format("{} '{}': this is a connection, not a group", what(group.at), group.text),
                "the activity of a group can be changed: 'Process/Group=value', 'Process/Group(x,y)=value'");
            return std::nullopt;
        }
        auto column = find_column(layout_, group.text, what(group.at), diagnostics_, group.at);
        if (!column || column->state == layout_.groups[column->group].type.output()) return column;
        diagnostics_.error(
            group.at,
            fmt::format("{} '{}': only the activity of a group can be changed", what(group.at), group.text),
            "leave out the state");
        return std::nullopt;
    }

    /// The manipulation of the same group with the same settings, or a new one.
    Made& find_same(const Spec& spec, Settings settings) {
        const auto key = [](const Spec& s) {
            return std::tuple(s.mode, s.cells.empty(), s.patterns.empty(), s.every, s.step, s.times,
                              s.backwards, std::string_view(s.from.text), std::string_view(s.until.text));
        };
        for (auto& other : made_)
            if (other.settings.group == settings.group && key(*other.spec) == key(spec)) return other;
        return made_.emplace_back(Made{&spec, std::move(settings), {}});
    }

    void add_patterns(const Spec& spec, Settings settings) {
        const GroupShape& shape = layout_.groups[settings.group].shape;
        const std::string& text = spec.patterns.text;
        std::string_view rest = text;
        if (const auto value = parse_number<double>(text))
            settings.patterns = {std::vector<double>(static_cast<std::size_t>(shape.cells), *value)};
        else if (text.empty() || out_of_range(text) || (take_number<double>(rest) && rest.empty()))
            diagnostics_.error(
                spec.patterns.at,
                fmt::format("{} '{}={}': {}", what(spec.patterns.at), spec.group.text, text, no_number(text)),
                "write a finite number for all cells, or the name of a file with patterns");
        else
            settings.patterns = read_patterns(text, shape, diagnostics_);
        if (!settings.patterns.empty()) made_.push_back({&spec, std::move(settings), {}});
    }

    void add_cells(const Spec& spec, Settings settings, const ColumnRef& column) {
        const std::string option = what(spec.cells.at);
        const expression::Context context{spec.cells.text, option, diagnostics_, spec.cells.at};
        const auto cells = context.parsed(&expression::parse_cell_values);
        if (!cells) return;
        auto& made = find_same(spec, std::move(settings));
        auto& own = made.settings;
        if (own.patterns.empty())
            own.patterns.emplace_back(static_cast<std::size_t>(layout_.groups[column.group].shape.cells),
                                      spec.mode == Spec::Mode::multiply ? 1 : 0);
        for (const auto& [source, value] : *cells) {
            const auto part = find_part(layout_, column, source, context);
            if (!part) continue;
            const auto cell = static_cast<int>(part->numbers.front());
            own.patterns.front()[part->numbers.front()] = value;
            if (spec.mode != Spec::Mode::clamp) continue;
            const auto clashes = [&](const Made& other) {
                return other.settings.group == own.group && other.settings.mode == own.mode &&
                       std::ranges::binary_search(other.settings.cells, cell) &&
                       (&other == &made || act_together(other, made));
            };
            if (std::ranges::any_of(made_, clashes))
                diagnostics_.error(spec.cells.at,
                                   fmt::format("{}: '{}{}' is clamped twice at the same time", option,
                                               spec.group.text, source.text()),
                                   separate);
            own.cells.insert(std::ranges::lower_bound(own.cells, cell), cell);
        }
    }

    void add_table(const Spec& spec, const Settings& settings) {
        try {
            const auto table = DriveTable::read(spec.table.text);
            for (const auto& row : table.rows())
                for (const int group : groups_of(row, {table.file(), row.line, row.column})) {
                    const auto& [path, id, shape, type, names] = layout_.groups[group];
                    if (row.values.size() != static_cast<std::size_t>(shape.cells)) {
                        auto error = DriveTable::size_error(row, path, shape);
                        error.where.file = table.file();
                        diagnostics_.add(std::move(error));
                        continue;
                    }
                    Settings own = settings;
                    own.group = group;
                    find_same(spec, std::move(own)).rows.emplace_back(row.cycle, row.values);
                }
        } catch (const FileError& e) {
            std::error_code none;
            if (std::filesystem::exists(std::filesystem::symlink_status(spec.table.text, none)))
                return report(e, diagnostics_);
            diagnostics_.error(
                {}, fmt::format("{} '{}': {}", what({}), spec.table.text, e.errors().front().message),
                "write 'Process/Group=value', 'Process/Group(x,y)=value' or 'Process/Group=FILE', or name a "
                "table of rows cycle,process,group,v0,v1,...");
        }
    }

    /// The groups that a row of a table names.
    std::vector<int> groups_of(const DriveTable::Row& row, const Location& at) {
        if (row.process != "*") {
            const auto column = manipulated({row.process + "/" + row.target, at});
            return column ? std::vector{column->group} : std::vector<int>();
        }
        const auto name_of = [](const engine::Layout::Group& g) {
            return std::string_view(g.path).substr(g.path.find('/') + 1);
        };
        std::vector<int> out;
        for (int g = 0; g < std::ssize(layout_.groups); ++g)
            if (name_of(layout_.groups[g]) == row.target) out.push_back(g);
        std::vector<std::string> names;
        if (out.empty())
            for (const auto& g : layout_.groups) names.emplace_back(name_of(g));
        if (out.empty())
            diagnostics_.error(at, fmt::format("no process has a group '{}'", row.target),
                               suggest(row.target, names));
        return out;
    }

    const engine::Layout& layout_;
    bool trials_;
    KnownLength length_;
    Diagnostics& diagnostics_;
    std::string mode_;
    std::vector<Made> made_;
};

}  // namespace

std::vector<std::unique_ptr<Manipulation>> make_manipulations(const std::vector<Spec>& specs,
                                                              const engine::Layout& layout, bool trials,
                                                              Diagnostics& diagnostics,
                                                              const KnownLength& length) {
    ManipulationReader reader(layout, trials, length, diagnostics);
    for (const auto& spec : specs) reader.add(spec);
    return reader.made();
}

}  // namespace forage::observe
