#include "core/xml/panel.h"

#include <fmt/format.h>

#include "core/xml/document.h"
#include "core/xml/source_tree.h"

namespace forage::xml {
std::vector<PanelRow> parse_panel(const std::string& path, const std::string& text,
                                  Diagnostics& diagnostics) {
    std::vector<PanelRow> out;
    const auto document = Document::parse({path, text}, "<HarborConfig>", 100'000, diagnostics);
    if (!document) return out;
    const Element root = document->root();
    const bool values = root.name() == "ParamSet";
    if (!values && root.name() != "HarborConfig") {
        diagnostics.error(root.where(),
                          fmt::format("<{}> is neither a panel nor a set of parameters", root.name()),
                          "a .hconf begins with <HarborConfig>, a .pconf with <ParamSet>");
        return out;
    }
    for (const Element row : root.children(values ? "Parameter" : "ParamTrade")) {
        const Value id = row["itemID"], name = row[values ? "name" : "ParamName"], value = row["value"];
        if (!id || !name || (values && !value)) {
            diagnostics.error(row.where(),
                              fmt::format("<{}> needs {}", row.name(),
                                          values ? "itemID, name and value" : "itemID and ParamName"));
            continue;
        }
        out.push_back({row["itemType"].text(), id.text(), name.text(), row["ParamLabel"].text(), value.text(),
                       row.where()});
    }
    return out;
}

std::string panel_text(const std::vector<PanelRow>& rows, bool values) {
    std::string out = values ? "<ParamSet>\n" : "<HarborConfig>\n";
    for (const PanelRow& r : rows)
        out += values ? fmt::format("  <Parameter itemType=\"{}\" itemID=\"{}\" name=\"{}\" value=\"{}\"/>\n",
                                    encoded(r.type), encoded(r.id), encoded(r.parameter), encoded(r.value))
                      : fmt::format(
                            "  <ParamTrade itemType=\"{}\" itemChild=\"\" itemID=\"{}\" ParamLabel=\"{}\" "
                            "ParamName=\"{}\"/>\n",
                            encoded(r.type), encoded(r.id), encoded(r.label), encoded(r.parameter));
    return out + (values ? "</ParamSet>\n" : "</HarborConfig>\n");
}

}  // namespace forage::xml
