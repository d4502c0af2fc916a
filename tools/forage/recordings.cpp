#include "tools/forage/recordings.h"

#include <cstdio>
#include <stdexcept>

#include "tools/forage/files.h"

namespace forage::tool {

std::map<std::string, observe::ColumnRef> recorded_columns(const std::vector<model::Wish>& wishes,
                                                           const engine::Simulation& simulation,
                                                           Diagnostics& diagnostics) {
    std::map<std::string, observe::ColumnRef> out;
    for (const auto& wish : wishes) {
        auto column = observe::find_column(simulation, wish.text, wish.at.file ? "record" : "--record",
                                           diagnostics, wish.at);
        if (!column) continue;
        std::string file = file_name(column->name) + ".csv";
        if (const auto it = out.find(file); it != out.end() && it->second.name != column->name)
            file = file_name(column->name + "_" + simulation.id(column->group)) + ".csv";
        out.emplace(std::move(file), std::move(*column));
    }
    return out;
}

Recordings::Recordings(std::map<std::string, observe::ColumnRef> columns, std::uint64_t every,
                       const std::string& directory, const engine::Simulation& simulation) {
    try {
        for (auto& [name, column] : columns) {
            const std::string path = directory + "/" + name;
            all_.push_back({name, path, {partial(path), simulation, std::move(column), every}});
        }
    } catch (...) {
        for (const auto& r : all_) std::remove(r.recorder.path().c_str());
        throw;
    }
}

std::string Recordings::finish() {
    std::string problems;
    for (auto& r : all_) {
        try {
            r.recorder.close();
        } catch (const std::exception& e) {
            problems += (problems.empty() ? "" : "; ") + std::string(e.what());
        }
        try {
            tool::finish(r.path);  // what it holds is whole in any case
        } catch (const std::exception& e) {
            problems += (problems.empty() ? "" : "; ") + std::string(e.what());
        }
    }
    return problems;
}

std::vector<std::string> Recordings::files() const {
    std::vector<std::string> out;
    for (const auto& r : all_) out.push_back(r.name);
    return out;
}

}  // namespace forage::tool
