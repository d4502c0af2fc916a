#include "core/model/experiment.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/separated.h"
#include "core/base/sequence.h"
#include "core/model/lookup.h"

namespace forage::model {

void read_trials(Measure& m, Diagnostics& diagnostics) {
    using Kind = Measure::Kind;
    if (m.kind != Kind::success && m.kind != Kind::duration && m.kind != Kind::distance) return;
    const auto said = trim(m.what.text);
    const auto n = said.starts_with("last ") ? parse_number<int>(trim(said.substr(5))) : std::nullopt;
    if (n && *n > 0)
        m.last = static_cast<std::uint64_t>(*n);
    else if (m.what.text != "all")
        diagnostics.error(m.what.at,
                          fmt::format("{} = '{}' does not name any trials",
                                      measure_kinds[static_cast<std::size_t>(m.kind)], m.what.text),
                          "'all', or for example 'last 100'");
}

void check_adaptation(const Experiment& e, Diagnostics& diagnostics) {
    if (!e.adaptation) return;
    const Adaptation& a = *e.adaptation;
    const auto named = [&](const Measure& m) { return m.name == a.measure.text; };
    if (!a.measure.empty() && std::ranges::none_of(e.measures, named)) {
        const auto names = names_of(e.measures);
        diagnostics.error(a.measure.at, fmt::format("there is no measure '{}'", a.measure.text),
                          names.empty() ? "the experiment measures nothing yet"
                                        : fmt::format("there are '{}'", separated(names, "', '")));
    }
    if (a.kind == Adaptation::Kind::halving) {
        if (e.sweeps.empty())
            diagnostics.error(a.at, "halving has nothing to choose from, because nothing is swept",
                              "sweep a parameter, or several systems");
        return;
    }
    if (!a.width == !a.relative_width)
        diagnostics.error(a.at, "the interval needs one width to reach",
                          "give it either 'width' or 'relative-width'");
    if (e.seeds.size() < 2)
        diagnostics.error(a.at, "an interval needs at least two seeds to begin with",
                          "for example <seeds count=\"5\"/>, or seeds=5 in Python");
    if (a.most > 0 && a.most < e.seeds.size())
        diagnostics.error(a.at,
                          fmt::format("at most {} seeds are allowed, but there are {} to begin with", a.most,
                                      e.seeds.size()),
                          "raise 'most', or begin with fewer seeds");
}

}  // namespace forage::model
