#include "core/model/experiment.h"

#include <fmt/format.h>

#include "core/base/number.h"
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

}  // namespace forage::model
