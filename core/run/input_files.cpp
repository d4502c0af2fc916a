#include "core/run/input_files.h"

#include <set>

#include "core/model/arrays.h"
#include "core/model/validate.h"

namespace forage {
namespace {

void add(InputFiles& all, const Location& where) {
    if (where.file) all[where.file->path] = sha256(where.file->text);
}

}  // namespace

InputFiles system_files(const model::System& system) {
    InputFiles out;
    add(out, system.at);
    for (const auto& p : system.processes) add(out, p.at);
    for (const auto& path : model::array_files(system)) out[path] = file_digest(path);
    return out;
}

std::vector<std::string> module_files(const model::System& system, const Registry& registry,
                                      const std::vector<model::Assignment>& changes) {
    std::set<std::string> out;
    for (const auto& p : system.processes) {
        const ModuleType* type = p.module ? registry.module(p.module->type) : nullptr;
        if (!type) continue;
        const auto module = type->make();
        model::apply(*p.module, type->parameters, module->parameters());
        for (const auto& parameter : type->parameters)
            if (parameter.is_path) out.insert(std::get<std::string>(parameter.get(module->parameters())));
    }
    for (const auto& change : changes)
        if (change.parameter && change.parameter->is_path) out.insert(std::get<std::string>(change.value));
    out.erase("");
    return {out.begin(), out.end()};
}

}  // namespace forage
