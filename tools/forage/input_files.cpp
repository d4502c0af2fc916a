#include "tools/forage/input_files.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "core/model/validate.h"
#include "tools/forage/files.h"

namespace forage::tool {
namespace {

void add(InputFiles& all, const Location& where) {
    if (where.file) all[where.file->path] = digest(where.file->text);
}

void add(InputFiles& all, const bug::Model& model) {
    add(all, model.where);
    for (const auto& link : model.links) {
        add(all, link.where);
        for (const auto& v : link.visuals)
            if (const auto& picture = v.material.texture; !picture.empty() && !all.contains(picture))
                all[picture] = file_digest(picture);
    }
    for (const auto& inner : model.models) add(all, inner);
}

}  // namespace

std::string file_digest(const std::string& path) {
    std::error_code none;  // what came through a pipe is not there any more
    if (!std::filesystem::is_regular_file(path, none)) return digest({});
    std::ifstream in(path, std::ios::binary);
    return digest({std::string(std::istreambuf_iterator<char>(in), {})});
}

InputFiles system_files(const Sources& sources) {
    InputFiles out;
    add(out, sources.system->at);
    for (const auto& p : sources.system->processes) add(out, p.at);
    for (const auto& p : sources.plugins) out[p.path] = file_digest(p.path);
    return out;
}

InputFiles world_files(const Sources& sources) {
    InputFiles out;
    for (const auto& m : sources.world->models) add(out, m);
    return out;
}

InputFiles input_files(const RunOptions& o, const Sources& sources) {
    InputFiles out = system_files(sources);
    const auto read = [&](const std::string& path) {
        if (!path.empty()) out[path] = file_digest(path);
    };
    if (sources.world) out.merge(world_files(sources)), read(o.input.world);
    read(o.input.drive);
    for (const auto& table : o.clamp) read(table);
    for (const auto& m : o.manipulations) read(m.patterns.text);
    return out;
}

std::vector<std::string> module_files(const Loaded& loaded, const observe::Schedule& schedule) {
    std::set<std::string> out;
    for (const auto& p : loaded.system.processes) {
        const ModuleType* type = p.module ? loaded.registry.module(p.module->type) : nullptr;
        if (!type) continue;
        const auto module = type->make();
        model::apply(p.module->settings, type->parameters, module->parameters());
        for (const auto& parameter : type->parameters)
            if (parameter.is_path) out.insert(std::get<std::string>(parameter.get(module->parameters())));
    }
    for (const auto& e : schedule.entries())
        if (e.change.parameter && e.change.parameter->is_path)
            out.insert(std::get<std::string>(e.change.value));
    out.erase("");
    return {out.begin(), out.end()};
}

}  // namespace forage::tool
