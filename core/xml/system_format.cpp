#include "core/xml/system_elements.h"

namespace forage::xml {
namespace {

Format format(std::string_view name, std::string_view beginning, std::string_view root) {
    return Format{.name = name,
                  .beginning = beginning,
                  .roots = {root},
                  .where_texts_stand = "write a text in a <Note>, and a remark in <!-- -->",
                  .values = {{"text", {}}},
                  .elements = rules_of(system_elements())}
        .link();
}

}  // namespace

const Format& system_format() {
    static const Format table = format("a system file", "<System ...>", "System");
    return table;
}

const Format& process_format() {
    static const Format table = format("a process file", "<iqrEntity ...>", "iqrEntity");
    return table;
}

}  // namespace forage::xml
